#include "spincat/io/formats/format.h"

namespace spincat::io {

#define FORMAT(name) ObjectFormat name##_format();
#include "spincat/io/formats/formats.inc"
#undef FORMAT

const std::vector<ObjectFormat>& object_formats() {
  static const std::vector<ObjectFormat> formats = {
#define FORMAT(name) name##_format(),
#include "spincat/io/formats/formats.inc"
#undef FORMAT
  };
  return formats;
}

}  // namespace spincat::io
