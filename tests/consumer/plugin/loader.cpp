#include <dlfcn.h>

#include <cstdio>

int main(int argc, char** argv) {
  void* const plugin = argc == 4 ? dlopen(argv[1], RTLD_NOW | RTLD_LOCAL) : nullptr;
  if (plugin == nullptr) {
    std::fprintf(stderr, "%s\n", argc == 4 ? dlerror() : "usage: loader PLUGIN MODEL FILE");
    return 1;
  }
  using NameOf = const char* (*)(const char*, const char*);
  const auto name_of = reinterpret_cast<NameOf>(dlsym(plugin, "name_of"));
  const char* const name = name_of != nullptr ? name_of(argv[2], argv[3]) : nullptr;
  std::puts(name != nullptr ? name : "nothing");
  return name != nullptr ? 0 : 1;
}
