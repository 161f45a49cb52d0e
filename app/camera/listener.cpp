#include "app/camera/listener.h"

#include <fmt/format.h>
#include <netdb.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

#include <cerrno>
#include <cstdint>
#include <cstring>
#include <memory>
#include <utility>

#include "spincat/error.h"
#include "spincat/files/system_error_text.h"

namespace spincat::app {
namespace {

constexpr int kWaiting = 1'024;  // connections that the system keeps for us

std::string in_brackets(const std::string& address) {
  return address.find(':') != std::string::npos ? "[" + address + "]" : address;
}

[[noreturn]] void fail(const std::string& address, int port, const std::string& why) {
  throw RunError(fmt::format("the live page cannot be served on {}:{}: {}", in_brackets(address), port, why));
}

// A socket that listens there, or nothing and errno.
Descriptor listening_at(const addrinfo& place) {
  Descriptor socket(::socket(place.ai_family, SOCK_STREAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0));
  const int on = 1;  // a port whose last owner has just ended is free
  if (!socket || setsockopt(socket.get(), SOL_SOCKET, SO_REUSEADDR, &on, sizeof on) != 0 ||
      bind(socket.get(), place.ai_addr, place.ai_addrlen) != 0 || listen(socket.get(), kWaiting) != 0) {
    const int error = errno;
    socket.close();
    errno = error;
  }
  return socket;
}

bool is_loopback(const sockaddr_storage& address) {
  constexpr std::uint32_t kLoopbackNet = 127;
  if (address.ss_family == AF_INET6) {
    const in6_addr& six = reinterpret_cast<const sockaddr_in6&>(address).sin6_addr;
    return IN6_IS_ADDR_LOOPBACK(&six) || (IN6_IS_ADDR_V4MAPPED(&six) && six.s6_addr[12] == kLoopbackNet);
  }
  return ntohl(reinterpret_cast<const sockaddr_in&>(address).sin_addr.s_addr) >> 24 == kLoopbackNet;
}

}  // namespace

Descriptor::Descriptor(Descriptor&& other) noexcept : number_(std::exchange(other.number_, -1)) {}

Descriptor& Descriptor::operator=(Descriptor&& other) noexcept {
  std::swap(number_, other.number_);
  return *this;
}

void Descriptor::close() {
  if (number_ >= 0) {
    ::close(std::exchange(number_, -1));
  }
}

Listener::Listener(const std::string& address, int port) {
  addrinfo wanted{};
  wanted.ai_socktype = SOCK_STREAM;
  wanted.ai_flags = AI_PASSIVE | AI_NUMERICSERV;
  addrinfo* found = nullptr;
  if (const int error = getaddrinfo(address.c_str(), std::to_string(port).c_str(), &wanted, &found); error != 0) {
    fail(address, port, error == EAI_SYSTEM ? system_error_text(errno) : "no such address");
  }
  const std::unique_ptr<addrinfo, void (*)(addrinfo*)> owner(found, freeaddrinfo);
  int error = 0;
  for (; found != nullptr && !socket_; found = found->ai_next) {
    socket_ = listening_at(*found);
    error = errno;
  }
  sockaddr_storage own{};
  socklen_t size = sizeof own;
  if (!socket_ || getsockname(socket_.get(), reinterpret_cast<sockaddr*>(&own), &size) != 0) {
    fail(address, port, system_error_text(socket_ ? errno : error));
  }
  is_local_ = is_loopback(own);
  port_ = ntohs(own.ss_family == AF_INET6 ? reinterpret_cast<const sockaddr_in6&>(own).sin6_port
                                          : reinterpret_cast<const sockaddr_in&>(own).sin_port);
}

}  // namespace spincat::app
