// tinygltf once more, so that the sanitizers and libFuzzer see into it: Debian's library is built without them.
#define TINYGLTF_IMPLEMENTATION
#include "spincat/io/formats/gltf_document.h"
