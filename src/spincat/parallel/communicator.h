// Ranks: the processes of one run, on one machine or many, and how they send each other bytes.
#pragma once

#include <chrono>
#include <cstddef>
#include <memory>
#include <optional>
#include <string>

namespace spincat {

// What was sent, or is to be: shared, so that the same bytes can be on their way to many ranks.
using SharedBytes = std::shared_ptr<const std::string>;

struct Message {
  int from = 0;
  int tag = 0;
  std::string bytes;
};

// The processes that run together. There are no collective operations and nothing blocks: a rank that was lost can
// never hold up another. May be used by several threads. Header only, so that an MPI of any make can be loaded as a
// plug-in (mpi_plugin.h).
class Communicator {
 public:
  using Clock = std::chrono::steady_clock;

  virtual ~Communicator() = default;

  virtual int rank() const = 0;  // of this process, 0 to size() - 1
  virtual int size() const = 0;
  virtual int ranks_on_host() const = 0;           // how many ranks share this machine, this one included
  virtual int ranks_on_processors() const = 0;     // those of them that may run on the same processors as this one
  virtual std::string implementation() const = 0;  // "Open MPI 4.1.4"; empty without MPI

  // Sends bytes of any length; returns at once. Messages from one rank to another arrive in the order in which they
  // were sent. `tag` is 0 to 100.
  virtual void send(int to, int tag, SharedBytes bytes) = 0;

  // The next message that has arrived completely, if any. Also moves on whatever is on its way.
  virtual std::optional<Message> receive() = 0;

  // Moves on what is on its way to a rank; whether nothing is left of it.
  virtual bool has_sent(int to) = 0;

  // The size of the messages to a rank that wait for others before them.
  virtual std::size_t bytes_waiting(int to) const = 0;

  // When anything last came from a rank, if only a part of a message.
  virtual Clock::time_point heard(int from) const = 0;

  // How many messages are on their way, to or from this rank, as far as this rank knows.
  virtual std::size_t under_way() const = 0;

  // From now on nothing is sent to or heard from this rank, and leaving does not wait for it.
  virtual void give_up(int rank) = 0;

  // Whether a rank was given up, or a message to or from it failed: what followed would be put together wrongly.
  virtual bool is_cut_off(int rank) const = 0;
};

// One process alone.
class SerialCommunicator final : public Communicator {
 public:
  int rank() const override { return 0; }
  int size() const override { return 1; }
  int ranks_on_host() const override { return 1; }
  int ranks_on_processors() const override { return 1; }
  std::string implementation() const override { return {}; }
  void send(int, int, SharedBytes) override {}
  std::optional<Message> receive() override { return std::nullopt; }
  bool has_sent(int) override { return true; }
  std::size_t bytes_waiting(int) const override { return 0; }
  Clock::time_point heard(int) const override { return {}; }
  std::size_t under_way() const override { return 0; }
  void give_up(int) override {}
  bool is_cut_off(int) const override { return false; }
};

}  // namespace spincat
