// Loaded before an MPI: one call of one function fails on one rank, as when a link breaks, or is where that rank stops
// (MPI_Init_thread). SPINCAT_FAIL says which, as "1 MPI_Isend 7" (rank, function, number of the call), "1 MPI_Isend:4
// 7" (of those with this tag), or "1 memory 7" for a request for 200,000 bytes or more; a file of that name says that
// it has come.
#include <dlfcn.h>
#include <mpi.h>

#include <atomic>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <new>
#include <sstream>
#include <string>

namespace {

bool fails(const char* function) {
  static const std::string wanted = [] {
    const char* text = std::getenv("SPINCAT_FAIL");
    return std::string(text != nullptr ? text : "");
  }();
  static std::atomic<int> calls{0};
  const char* open = std::getenv("OMPI_COMM_WORLD_RANK");
  const char* rank = open != nullptr ? open : std::getenv("PMI_RANK");
  std::istringstream fields(wanted);
  std::string wanted_rank;
  std::string wanted_function;
  int wanted_call = 0;
  fields >> wanted_rank >> wanted_function >> wanted_call;
  if (rank == nullptr || wanted_rank != rank || wanted_function != function || ++calls != wanted_call) {
    return false;
  }
  std::ofstream{wanted};
  return true;
}

// The MPI comes later, with the plug-in.
template <class Function>
Function own(Function, const char* name) {
  return reinterpret_cast<Function>(dlsym(RTLD_DEFAULT, name));
}

}  // namespace

void* operator new(std::size_t size) {
  void* memory = size >= 200'000 && fails("memory") ? nullptr : std::malloc(size);
  if (memory == nullptr) {
    throw std::bad_alloc();
  }
  return memory;
}

void operator delete(void* memory) noexcept {
  std::free(memory);
}

void operator delete(void* memory, std::size_t) noexcept {
  std::free(memory);
}

extern "C" {

int MPI_Init_thread(int* count, char*** arguments, int required, int* provided) {
  if (fails("MPI_Init_thread")) {
    raise(SIGSTOP);
  }
  return own(&MPI_Init_thread, "PMPI_Init_thread")(count, arguments, required, provided);
}

int MPI_Isend(const void* bytes, int count, MPI_Datatype type, int to, int tag, MPI_Comm ranks, MPI_Request* request) {
  return fails("MPI_Isend") || fails(("MPI_Isend:" + std::to_string(tag)).c_str())
             ? MPI_ERR_OTHER
             : own(&MPI_Isend, "PMPI_Isend")(bytes, count, type, to, tag, ranks, request);
}

int MPI_Imrecv(void* bytes, int count, MPI_Datatype type, MPI_Message* message, MPI_Request* request) {
  return fails("MPI_Imrecv") ? MPI_ERR_OTHER : own(&MPI_Imrecv, "PMPI_Imrecv")(bytes, count, type, message, request);
}

int MPI_Test(MPI_Request* request, int* done, MPI_Status* status) {
  return fails("MPI_Test") ? MPI_ERR_OTHER : own(&MPI_Test, "PMPI_Test")(request, done, status);
}
}
