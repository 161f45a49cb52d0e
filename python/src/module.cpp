// The module _spincat. People use the Python files around it, which have the documentation; what is bound here takes
// everything by position, and the stub beside those files says what.
#include "bindings.h"

PYBIND11_MODULE(_spincat, module) {
  using namespace spincat::python;
  pybind11::options options;
  options.disable_function_signatures();
  module.attr("__version__") = SPINCAT_VERSION;
  bind_errors(module);
  bind_settings(module);
  bind_objects(module);
  bind_spin_images(module);
  bind_describe(module);
  bind_model(module);
  bind_ballot(module);
  bind_evaluate(module);
  bind_camera(module);
}
