# spincat_embed(TARGET NAME FILE): the bytes of FILE as spincat::embedded::NAME() in the target, taken when it is built.
# The assembler reads the file (ELF): megabytes cost no time, and any byte is allowed.
function(spincat_embed target name file)
  set(symbol spincat_embedded_${name})
  set(source ${CMAKE_CURRENT_BINARY_DIR}/embedded/${name}.cpp)
  file(CONFIGURE OUTPUT ${source} @ONLY CONTENT [=[
#include "spincat/report/embedded.h"

asm(R"(
    .pushsection .rodata
    .global @symbol@, @symbol@_end
@symbol@:
    .incbin "@file@"
@symbol@_end:
    .popsection
)");
extern "C" const char @symbol@[];
extern "C" const char @symbol@_end[];

std::string_view spincat::embedded::@name@() {
  return {@symbol@, static_cast<std::size_t>(@symbol@_end - @symbol@)};
}
]=])
  # Not in a batch of files, which would not know what it depends on.
  set_source_files_properties(${source} PROPERTIES OBJECT_DEPENDS ${file} SKIP_UNITY_BUILD_INCLUSION ON)
  target_sources(${target} PRIVATE ${source})
endfunction()
