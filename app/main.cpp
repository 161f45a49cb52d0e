// The spincat command. Results go to standard output, everything else to standard error.
// Exit codes: 0 done, 1 could not do it, 2 wrong use or bad input, 128 + n ended by signal n.
#include <fmt/format.h>
#include <malloc.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <exception>
#include <functional>
#include <memory>
#include <new>
#include <string>
#include <system_error>
#include <vector>

#include "app/commands/commands.h"
#include "app/ranks/mpi_watch.h"
#include "app/ranks/ranks.h"
#include "app/terminal/command_line.h"
#include "app/terminal/help_format.h"
#include "app/terminal/interrupt.h"
#include "app/terminal/messages.h"
#include "app/terminal/parse_errors.h"
#include "app/version.h"
#include "spincat/error.h"
#include "spincat/parallel/placement.h"
#include "spincat/parallel/task_farm.h"
#include "spincat/parallel/task_server.h"
#include "spincat/rank_work.h"

namespace {

using namespace spincat;       // NOLINT(google-build-using-namespace)
using namespace spincat::app;  // NOLINT(google-build-using-namespace)

// Each object takes and gives back some megabytes: asking the kernel for them anew, which clears them, would cost a
// quarter of the time of a small one.
void keep_memory() {
  mallopt(M_MMAP_THRESHOLD, 32 << 20);  // the most that it takes
  mallopt(M_TRIM_THRESHOLD, 64 << 20);
}

int fail(const std::string& problem, int code) {
  message(problem);
  return code;
}

// Wrong use in one line; --help and --version print and succeed.
int report_parse_error(const CLI::App& cli, const CLI::ParseError& error) {
  return error.get_exit_code() == 0 ? cli.exit(error) : fail(parse_error_text(cli, error), 2);
}

// What was printed must have arrived: a full disk behind "> file" is an error.
int flush_output(int code) {
  if (std::fflush(stdout) != 0 || std::ferror(stdout) != 0) {
    return fail(fmt::format("standard output: {}", std::strerror(errno)), 1);
  }
  return code;
}

// The exit code, and one line on standard error for what went wrong.
int report_errors(const std::function<int()>& body) {
  try {
    return body();
  } catch (const InputError& error) {
    return fail(error.what(), 2);
  } catch (const Interrupted& interrupted) {
    return fail("interrupted", 128 + interrupted.signal);
  } catch (const std::system_error& error) {
    const bool printing = std::ferror(stdout) != 0;
    return fail(printing ? "standard output: " + error.code().message() : error.what(), 1);
  } catch (const std::bad_alloc&) {
    return fail("not enough memory", 1);
  } catch (const std::exception& error) {  // RunError, and whatever a library throws
    return fail(error.what(), 1);
  }
}

// On rank 0, where there are several.
int run(int argc, char** argv, TaskFarm& farm) {
  CLI::App cli(
      "spincat learns object categories from 3D models by spin images and pairwise judges, and names new ones.",
      "spincat");
  cli.formatter(std::make_shared<HelpFormat>());  // before the commands, which take it over
  cli.footer(
      "Example:\n"
      "  spincat train models/ -o my.spincat      learn: a sub-folder per category\n"
      "  spincat classify my.spincat new.obj      name an object\n"
      "  spincat evaluate models/                 measure how often the names are right\n"
      "spincat COMMAND --help tells more.");
  cli.set_version_flag("--version", version_text, "Print the version and what this build can do");
  cli.require_subcommand(1);
  const std::vector<NamedCommand> commands = add_commands(cli);
  if (argc > 1 && argv[1][0] != '-' && std::ranges::find(commands, argv[1], &NamedCommand::name) == commands.end()) {
    throw InputError(fmt::format("there is no command '{}' (spincat --help lists them)", argv[1]));
  }
  try {
    cli.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return flush_output(report_parse_error(cli, error));
  }
  for (const NamedCommand& command : commands) {
    if (cli.got_subcommand(command.name)) {
      return flush_output(command.run(farm));
    }
  }
  return 2;
}

// MPI's end would wait for the rank that has gone.
[[noreturn]] void leave_abandoned(const Launch& launch) {
  if (launch.number == 1) {  // one voice is enough
    message("rank 0 or the launcher has gone; run the same command again to continue");
  }
  std::_Exit(1);
}

// What goes wrong here costs rank 0 a worker and not the result: whether there is one, its exit code says.
int work_for_rank0(Communicator& ranks, const Launch& launch) {
  ServiceRules rules;
  rules.thread_count = [&](int requested) { return thread_count(requested, placement_of(ranks)); };
  rules.keep_going = stop_if_interrupted;
  rules.leaves_silent_rank0 = launch.outlives_ranks;
  try {
    if (serve(ranks, rank_work(), rules) == ServiceEnd::abandoned) {
      leave_abandoned(launch);
    }
    return 0;
  } catch (const Interrupted& interrupted) {
    return 128 + interrupted.signal;
  } catch (const std::exception&) {
    return 0;
  }
}

// Rank 0 runs the command; the others work for it and say nothing.
int run_on_ranks(int argc, char** argv, const Launch& launch) {
  const std::shared_ptr<HostRanks> host = ranks_of_host();
  std::unique_ptr<MpiWatch> watch = watch_start(launch, host);
  std::unique_ptr<Communicator> ranks = join_ranks(launch);
  watch.reset();
  int code = 0;
  if (ranks->rank() == 0) {
    TaskFarm farm(*ranks, farm_policy());  // its end waits for the others as long as they are heard
    code = report_errors([&] { return run(argc, argv, farm); });
  } else {
    code = work_for_rank0(*ranks, launch);
  }
  watch = watch_end(launch, host, {code, ranks->ranks_on_host() == ranks->size()});
  ranks.reset();  // ends MPI
  watch.reset();
  leave_last(launch, *host);
  return code;
}

}  // namespace

int main(int argc, char** argv) {
  keep_memory();
  fill_closed_streams();
  catch_interrupts();
  keep_command_line(argc, argv);
  const Launch launch = read_launch();
  if (launch.number > 0) {
    try {
      return run_on_ranks(argc, argv, launch);
    } catch (const std::exception&) {
      return 1;
    }
  }
  return report_errors([&] { return run_on_ranks(argc, argv, launch); });
}
