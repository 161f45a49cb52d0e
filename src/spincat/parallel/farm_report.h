// How the work was spread over ranks.
#pragma once

#include <cstddef>
#include <map>
#include <string>
#include <vector>

namespace spincat {

struct FarmReport {
  struct Rank {
    std::string host;
    int threads = 0;            // 0 when it never took part
    double busy_seconds = 0.0;  // added up over its threads
    bool lost = false;
    std::string refusal;  // why it could not take part in a job, the last time
  };

  std::vector<Rank> ranks;
  double seconds = 0.0;                             // while there was work for ranks
  std::size_t handed_out_again = 0;                 // tasks of ranks that were lost
  std::size_t resumed = 0;                          // tasks that the journal had
  std::map<std::string, std::size_t> remote_tasks;  // of each kind, done by other ranks; only where asked for

  // One line: ranks, hosts, threads, how busy each was, what was lost.
  std::string text() const;
};

}  // namespace spincat
