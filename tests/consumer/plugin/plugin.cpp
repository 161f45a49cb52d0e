#include <spincat/spincat.h>

#include <string>

// The name of the object, or nothing.
extern "C" const char* name_of(const char* model_file, const char* object_file) {
  static std::string name;
  try {
    const spincat::Model model = spincat::read_model(model_file);
    name = model.categories()[spincat::classify_file(model, object_file).ballot.winner];
    return name.c_str();
  } catch (const spincat::Error&) {
    return nullptr;
  }
}
