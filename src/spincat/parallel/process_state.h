// What the kernel tells of another process of this machine.
#pragma once

#include <cstdint>

namespace spincat {

// Whether it is there at all: neither ended nor a zombie that nobody has waited for yet.
bool is_there(std::int64_t process);

// Whether it is stopped, as by SIGSTOP.
bool is_stopped(std::int64_t process);

// Whether it runs the same program as this one: the number of a process that has gone may be another's by now.
bool runs_our_program(std::int64_t process);

}  // namespace spincat
