// The MPI plug-in: a Communicator over any MPI of version 3 or later.
//
// Only point-to-point messages that do not block. A large message goes as pieces of bounded size, the first of which
// begins with the length of the whole; so no length overflows MPI's counts, and a rank that dies in the middle of a
// message leaves nobody waiting inside MPI.
#include <mpi.h>
#include <sched.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <deque>
#include <iterator>
#include <list>
#include <mutex>
#include <thread>
#include <utility>
#include <vector>

#include "spincat/parallel/communicator.h"
#include "spincat/parallel/mpi/mpi_plugin.h"

namespace spincat {
namespace {

constexpr std::size_t kPiece = std::size_t{1} << 20;
constexpr std::size_t kShort = std::size_t{1} << 14;  // a message that is sent with its length, as one piece
constexpr std::size_t kHead = sizeof(std::uint64_t);  // of a message's first piece: the length of the whole
// MPICH 4.0 hangs at its end over TCP where a rank still answers another that has come there first (pmodels/mpich, pull
// request 6596); see below.
#ifdef MPICH_VERSION
constexpr bool kIsMuteBeforeEnd = true;
#else
constexpr bool kIsMuteBeforeEnd = false;
#endif
constexpr std::chrono::milliseconds kMute(300);  // more than it takes TCP to send again what was lost
constexpr std::chrono::milliseconds kRank0Mute(600);
constexpr int kPiecesAtOnce = 4;  // to one rank

// A message to one rank, piece by piece.
struct Outgoing {
  int tag = 0;
  SharedBytes bytes;
  std::string first;      // head and first bytes; empty until it is sent
  std::size_t begun = 0;  // bytes of `bytes` that were handed to MPI
};

struct Piece {
  MPI_Request request = MPI_REQUEST_NULL;
  std::shared_ptr<const Outgoing> message;  // keeps the bytes
};

// Lists, as MPI has the addresses of what they hold.
struct OutBox {
  std::deque<std::shared_ptr<Outgoing>> waiting;
  std::size_t bytes_waiting = 0;  // of which nothing was sent
  std::list<Piece> under_way;
};

struct IncomingPiece {
  MPI_Request request = MPI_REQUEST_NULL;
  int tag = 0;
  std::string bytes;
};

struct InBox {
  Communicator::Clock::time_point heard = Communicator::Clock::now();
  std::list<IncomingPiece> under_way;
  bool in_message = false;
  std::uint64_t length = 0;  // of the message that is being put together
  Message message;
};

enum class Transfer { under_way, done, failed };

Transfer state_of(MPI_Request& request) {
  int done = 0;
  if (MPI_Test(&request, &done, MPI_STATUS_IGNORE) != MPI_SUCCESS) {
    return Transfer::failed;
  }
  return done != 0 ? Transfer::done : Transfer::under_way;
}

// Of a rank that is cut off: forgets what MPI is done with, and keeps the memory of what failed, which MPI may still
// use.
template <class Piece>
void let_go(std::list<Piece>& pieces, std::list<Piece>& kept) {
  for (auto piece = pieces.begin(); piece != pieces.end();) {
    const Transfer state = state_of(piece->request);
    const auto next = std::next(piece);
    if (state == Transfer::done) {
      pieces.erase(piece);
    } else if (state == Transfer::failed) {
      kept.splice(kept.end(), pieces, piece);
    }
    piece = next;
  }
}

// How many of the ranks of this host may run on the same processors as this one.
int ranks_bound_alike(MPI_Comm host, int ranks) {
  using Processors = std::array<char, sizeof(cpu_set_t)>;
  cpu_set_t allowed;
  CPU_ZERO(&allowed);
  sched_getaffinity(0, sizeof(allowed), &allowed);
  Processors own{};
  std::memcpy(own.data(), &allowed, sizeof(allowed));
  std::vector<Processors> of_ranks(static_cast<std::size_t>(ranks), own);
  MPI_Allgather(own.data(), static_cast<int>(own.size()), MPI_BYTE, of_ranks.data(), static_cast<int>(own.size()),
                MPI_BYTE, host);
  return static_cast<int>(std::ranges::count(of_ranks, own));
}

class MpiCommunicator final : public Communicator {
 public:
  MpiCommunicator() {
    MPI_Comm_rank(MPI_COMM_WORLD, &rank_);
    MPI_Comm_size(MPI_COMM_WORLD, &size_);
    MPI_Comm host = MPI_COMM_NULL;
    MPI_Comm_split_type(MPI_COMM_WORLD, MPI_COMM_TYPE_SHARED, 0, MPI_INFO_NULL, &host);
    MPI_Comm_size(host, &ranks_on_host_);
    ranks_on_processors_ = ranks_bound_alike(host, ranks_on_host_);
    MPI_Comm_free(&host);
    out_.resize(static_cast<std::size_t>(size_));
    in_.resize(static_cast<std::size_t>(size_));
    cut_off_.resize(static_cast<std::size_t>(size_), false);
  }

  // Sends what is to be sent. Then MPICH asks each rank that it has sent to over TCP for a last answer, and listens no
  // more when it has them all: a rank that comes later, having given its own before, waits for ever. So all stop to
  // listen first, and go to the end when all have; rank 0, whose answer those on other hosts need, last of all.
  ~MpiCommunicator() override {
    const bool all_there = std::ranges::find(cut_off_, true) == cut_off_.end();
    while (all_there && !std::ranges::all_of(out_, is_clear)) {
      move_on();
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    if (kIsMuteBeforeEnd && ranks_on_host_ < size_) {
      std::this_thread::sleep_for(rank_ == 0 ? kRank0Mute : kMute);
    }
    MPI_Finalize();
  }

  int rank() const override { return rank_; }
  int size() const override { return size_; }
  int ranks_on_host() const override { return ranks_on_host_; }
  int ranks_on_processors() const override { return ranks_on_processors_; }

  std::string implementation() const override {
    std::array<char, MPI_MAX_LIBRARY_VERSION_STRING> text{};
    int length = 0;
    MPI_Get_library_version(text.data(), &length);
    std::string name(text.data(), static_cast<std::size_t>(length));
    std::ranges::replace(name, '\t', ' ');
    std::erase_if(name, [](char c) { return c == ':' || c == '\0'; });
    return name.substr(0, name.find_first_of(",\n"));
  }

  void send(int to, int tag, SharedBytes bytes) override {
    const std::lock_guard lock(mutex_);
    if (is_off(to)) {
      return;
    }
    auto message = std::make_shared<Outgoing>();
    message->tag = tag;
    message->bytes = std::move(bytes);
    OutBox& box = out_[static_cast<std::size_t>(to)];
    box.bytes_waiting += message->bytes->size();
    box.waiting.push_back(std::move(message));
    move_on_sending(to);
  }

  std::optional<Message> receive() override {
    const std::lock_guard lock(mutex_);
    move_on();
    for (int i = 0; i < size_; ++i) {
      next_source_ = (next_source_ + 1) % size_;
      if (std::optional<Message> message = assemble(next_source_)) {
        return message;
      }
    }
    return std::nullopt;
  }

  bool has_sent(int to) override {
    const std::lock_guard lock(mutex_);
    move_on_sending(to);
    return is_clear(out_[static_cast<std::size_t>(to)]);
  }

  std::size_t bytes_waiting(int to) const override {
    const std::lock_guard lock(mutex_);
    return out_[static_cast<std::size_t>(to)].bytes_waiting;
  }

  Clock::time_point heard(int from) const override {
    const std::lock_guard lock(mutex_);
    return in_[static_cast<std::size_t>(from)].heard;
  }

  std::size_t under_way() const override {
    const std::lock_guard lock(mutex_);
    std::size_t count = 0;
    for (int r = 0; r < size_; ++r) {
      const auto i = static_cast<std::size_t>(r);
      if (!cut_off_[i]) {
        count += out_[i].waiting.size() + out_[i].under_way.size() + in_[i].under_way.size();
      }
    }
    return count;
  }

  void give_up(int rank) override {
    const std::lock_guard lock(mutex_);
    cut_off(rank);
  }

  bool is_cut_off(int rank) const override {
    const std::lock_guard lock(mutex_);
    return is_off(rank);
  }

 private:
  static bool is_clear(const OutBox& box) { return box.waiting.empty() && box.under_way.empty(); }

  bool is_off(int rank) const { return cut_off_[static_cast<std::size_t>(rank)]; }

  void cut_off(int rank) {
    cut_off_[static_cast<std::size_t>(rank)] = true;
    out_[static_cast<std::size_t>(rank)].waiting.clear();
    out_[static_cast<std::size_t>(rank)].bytes_waiting = 0;
  }

  void move_on() {
    for (int r = 0; r < size_; ++r) {
      move_on_sending(r);
    }
    start_receiving();
  }

  void move_on_sending(int to) {
    OutBox& box = out_[static_cast<std::size_t>(to)];
    while (!is_off(to) && !box.under_way.empty()) {
      const Transfer state = state_of(box.under_way.front().request);
      if (state == Transfer::under_way) {
        break;
      }
      if (state == Transfer::failed) {
        cut_off(to);
      } else {
        box.under_way.pop_front();
      }
    }
    if (is_off(to)) {
      let_go(box.under_way, failed_out_);
    }
    while (!box.waiting.empty() && box.under_way.size() < kPiecesAtOnce) {
      start_piece(to, box);
    }
  }

  // Not before it is sent: many ranks may wait for the same bytes. Those of a long message are sent from where they
  // are.
  static void pack_first(Outgoing& message) {
    const std::uint64_t length = message.bytes->size();
    const std::size_t in_first = length <= kShort ? message.bytes->size() : 0;
    message.first.resize(kHead + in_first);
    std::memcpy(message.first.data(), &length, kHead);
    std::memcpy(message.first.data() + kHead, message.bytes->data(), in_first);
  }

  void start_piece(int to, OutBox& box) {
    const std::shared_ptr<Outgoing> message = box.waiting.front();
    const bool is_first = message->first.empty();
    if (is_first) {
      pack_first(*message);
      box.bytes_waiting -= message->bytes->size();
    }
    const std::size_t size =
        is_first ? message->first.size() : std::min(kPiece, message->bytes->size() - message->begun);
    const char* const from = is_first ? message->first.data() : message->bytes->data() + message->begun;
    message->begun += is_first ? size - kHead : size;
    Piece& piece = box.under_way.emplace_back();
    piece.message = message;
    // NOLINTNEXTLINE(clang-analyzer-optin.mpi.MPI-Checker): MPI_Test ends it
    const int sent =
        MPI_Isend(from, static_cast<int>(size), MPI_BYTE, to, message->tag, MPI_COMM_WORLD, &piece.request);
    if (sent != MPI_SUCCESS) {
      box.under_way.pop_back();
      cut_off(to);
    } else if (message->begun == message->bytes->size()) {
      box.waiting.pop_front();
    }
  }

  // Begins to receive every piece that has come.
  void start_receiving() {
    while (true) {
      int there = 0;
      MPI_Message message = MPI_MESSAGE_NULL;
      MPI_Status status;
      MPI_Improbe(MPI_ANY_SOURCE, MPI_ANY_TAG, MPI_COMM_WORLD, &there, &message, &status);
      if (there == 0) {
        return;
      }
      int size = 0;
      MPI_Get_count(&status, MPI_BYTE, &size);
      InBox& box = in_[static_cast<std::size_t>(status.MPI_SOURCE)];
      box.heard = Clock::now();
      receive_piece(box, status.MPI_SOURCE, status.MPI_TAG, size, message);
    }
  }

  // What follows a piece that cannot come (there is no memory for it, say) cannot be put together.
  void receive_piece(InBox& box, int from, int tag, int size, MPI_Message message) {
    try {
      IncomingPiece& piece = box.under_way.emplace_back();
      piece.tag = tag;
      piece.bytes.resize(static_cast<std::size_t>(size));
      if (MPI_Imrecv(piece.bytes.data(), size, MPI_BYTE, &message, &piece.request) != MPI_SUCCESS) {
        cut_off(from);
      }
    } catch (...) {
      cut_off(from);
      throw;
    }
  }

  // Puts together what has come from a rank, until a message is whole.
  std::optional<Message> assemble(int from) {
    InBox& box = in_[static_cast<std::size_t>(from)];
    while (!is_off(from) && !box.under_way.empty()) {
      const Transfer state = state_of(box.under_way.front().request);
      if (state == Transfer::under_way) {
        break;
      }
      if (state == Transfer::failed) {
        cut_off(from);
        break;
      }
      IncomingPiece piece = std::move(box.under_way.front());
      box.under_way.pop_front();
      box.heard = Clock::now();
      try {
        add(piece, from, box);
      } catch (...) {
        cut_off(from);
        throw;
      }
      if (!box.in_message && !is_off(from)) {
        return std::move(box.message);
      }
    }
    if (is_off(from)) {
      let_go(box.under_way, failed_in_);
    }
    return std::nullopt;
  }

  void add(IncomingPiece& piece, int from, InBox& box) {
    if (box.in_message) {
      append(std::move(piece.bytes), box);
    } else if (piece.bytes.size() < kHead) {
      cut_off(from);
    } else {
      std::memcpy(&box.length, piece.bytes.data(), kHead);
      box.message = {from, piece.tag, piece.bytes.substr(kHead)};
    }
    box.in_message = box.message.bytes.size() < box.length;
  }

  // A piece that is the whole message need not be copied.
  static void append(std::string bytes, InBox& box) {
    if (bytes.size() == box.length) {
      box.message.bytes = std::move(bytes);
    } else {
      box.message.bytes.reserve(box.length);
      box.message.bytes += bytes;
    }
  }

  int rank_ = 0;
  int size_ = 1;
  int ranks_on_host_ = 1;
  int ranks_on_processors_ = 1;
  mutable std::mutex mutex_;  // of all that follows, and of messages in MPI
  int next_source_ = 0;
  std::vector<OutBox> out_;
  std::vector<InBox> in_;
  std::list<Piece> failed_out_;
  std::list<IncomingPiece> failed_in_;
  std::vector<bool> cut_off_;
};

// Ranks of one host need no network: looking for one takes most of Open MPI's start. Nor need they wait for each other
// at the end, where one may be missing: the farm has them come to it together if it can, and a launcher that finds one
// killed in that barrier may hang or crash (Open MPI 4.1.4 with PMIx 4.2.2). What the user has set stays.
void choose_for_one_host() {
  const char* all = std::getenv("OMPI_COMM_WORLD_SIZE");
  const char* here = std::getenv("OMPI_COMM_WORLD_LOCAL_SIZE");
  if (all != nullptr && here != nullptr && std::strcmp(all, here) == 0) {
    setenv("OMPI_MCA_pml", "ob1", 0);
    setenv("OMPI_MCA_btl", "self,vader", 0);
    setenv("OMPI_MCA_async_mpi_finalize", "1", 0);
  }
}

}  // namespace
}  // namespace spincat

extern "C" {

int spincat_mpi_plugin_version() {
  return spincat::kMpiPluginVersion;
}

spincat::Communicator* spincat_join_ranks() {
  spincat::choose_for_one_host();
  int provided = 0;
  if (MPI_Init_thread(nullptr, nullptr, MPI_THREAD_SERIALIZED, &provided) != MPI_SUCCESS ||
      provided < MPI_THREAD_SERIALIZED) {
    return nullptr;
  }
  MPI_Comm_set_errhandler(MPI_COMM_WORLD, MPI_ERRORS_RETURN);
  return new spincat::MpiCommunicator();
}
}
