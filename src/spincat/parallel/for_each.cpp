#include "spincat/parallel/for_each.h"

#include <sched.h>
#include <unistd.h>

#include <algorithm>
#include <cstddef>

#include "spincat/geometry/parallel_for.h"

namespace spincat {

int allowed_processors() {
  cpu_set_t allowed;
  if (sched_getaffinity(0, sizeof(allowed), &allowed) != 0) {
    return 1;
  }
  return std::max(1, CPU_COUNT(&allowed));
}

int all_processors() {
  return std::max(1, static_cast<int>(sysconf(_SC_NPROCESSORS_ONLN)));
}

int thread_count(int requested) {
  return requested > 0 ? requested : allowed_processors();
}

void for_each_index(std::size_t count, int threads, const std::function<void(std::size_t)>& body) {
  parallel_for(count, threads, body);
}

}  // namespace spincat
