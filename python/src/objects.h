// Objects as Python holds them: never changed, and shared by all that refer to them.
#pragma once

#include <pybind11/pybind11.h>
#include <spincat/spincat.h>

#include <filesystem>
#include <memory>
#include <string>
#include <variant>
#include <vector>

namespace spincat::python {

// Python's class Object.
struct Shape {
  std::shared_ptr<const Object> object;
  std::filesystem::path file;  // it was read from; empty where it was made of arrays
};

// What functions take for an object: itself, or the name of a file.
using Item = std::variant<Shape, std::filesystem::path>;

// One object, or the items of a sequence of them. Throw InputError, which begins with `name`, for anything else.
Item item_of(const pybind11::handle& given, const std::string& name);
std::vector<Item> items_of(const pybind11::handle& given, const std::string& name);

// The object itself, read where it is a file.
Shape shape_of(const Item& item);

// The item as messages call it: its file, or "objects[3]".
std::string name_of(const Item& item, std::size_t index);

// What `work` returns. An InputError of it that knows no file gets the name of the item.
template <class Work>
auto naming_item(const Item& item, std::size_t index, Work&& work) {
  try {
    return work();
  } catch (const InputError& error) {
    throw error.file().empty() ? InputError(name_of(item, index), error.problem()) : error;
  }
}

// A page of the reports in a frame that notebooks show.
std::string framed(const std::string& page);

}  // namespace spincat::python
