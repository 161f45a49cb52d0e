// A socket that waits for others, on an address of ours.
#pragma once

#include <string>

namespace spincat::app {

// A file descriptor that is closed with its owner.
class Descriptor {
 public:
  explicit Descriptor(int number = -1) : number_(number) {}
  ~Descriptor() { close(); }
  Descriptor(Descriptor&& other) noexcept;
  Descriptor& operator=(Descriptor&& other) noexcept;
  int get() const { return number_; }
  explicit operator bool() const { return number_ >= 0; }
  void close();

 private:
  int number_;
};

class Listener {
 public:
  // Port 0: any that is free. Throws RunError when the place cannot be had: no such address, or another has it.
  Listener(const std::string& address, int port);

  int descriptor() const { return socket_.get(); }
  int port() const { return port_; }
  // Nobody on another machine can reach it.
  bool is_local() const { return is_local_; }

 private:
  Descriptor socket_;
  int port_ = 0;
  bool is_local_ = false;
};

}  // namespace spincat::app
