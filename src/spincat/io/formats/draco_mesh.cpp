#include "spincat/io/formats/draco_mesh.h"

#include <fmt/format.h>

#include <exception>
#include <memory>
#include <optional>
#include <utility>

#include "spincat/error.h"
#include "spincat/io/text_cursor.h"

#ifdef SPINCAT_DRACO
#include <draco/compression/config/decoder_options.h>
#include <draco/compression/mesh/mesh_edgebreaker_decoder.h>
#include <draco/compression/mesh/mesh_sequential_decoder.h>
#include <draco/core/decoder_buffer.h>
#include <draco/mesh/mesh.h>
#endif

namespace spincat::io {

#ifdef SPINCAT_DRACO

namespace {

using ExpectMemory = std::function<void(std::uint64_t)>;

// The next numbers of 7 bits a byte, without moving on.
class Peek {
 public:
  explicit Peek(const draco::DecoderBuffer& buffer)
      : bytes_(buffer.data_head(), static_cast<std::size_t>(buffer.remaining_size())) {}

  // 0 behind the end: the decoder will find that out itself.
  std::uint64_t number() {
    std::uint64_t value = 0;
    for (unsigned shift = 0; shift < 35 && !bytes_.empty(); shift += 7) {
      const auto part = static_cast<unsigned char>(bytes_[0]);
      bytes_.remove_prefix(1);
      value |= std::uint64_t{part & 0x7FU} << shift;
      if (part < 0x80) {
        break;
      }
    }
    return value;
  }
  std::uint64_t byte() {
    const std::uint64_t value = bytes_.empty() ? 0 : static_cast<unsigned char>(bytes_[0]);
    bytes_.remove_prefix(bytes_.empty() ? 0 : 1);
    return value;
  }

 private:
  std::string_view bytes_;
};

// The memory that a mesh takes by the few bytes with which its connectivity begins.
std::uint64_t memory_of_connectivity(const draco::MeshSequentialDecoder&, Peek peek) {
  constexpr std::uint64_t kForEachFace = 36, kForEachPoint = 8;
  const std::uint64_t faces = peek.number();
  return kForEachFace * faces + kForEachPoint * peek.number();
}
std::uint64_t memory_of_connectivity(const draco::MeshEdgebreakerDecoder&, Peek peek) {
  constexpr std::uint64_t kForEachFace = 50, kForEachVertex = 24;
  constexpr std::uint64_t kFaceOfAttribute = 40, kVertexOfAttribute = 20;
  const std::uint64_t encoded = peek.number();
  const std::uint64_t faces = peek.number();
  const std::uint64_t attributes = peek.byte();
  peek.number();  // of symbols: no more than faces
  const std::uint64_t vertices = encoded + peek.number();
  return faces * (kForEachFace + kFaceOfAttribute * attributes) +
         vertices * (kForEachVertex + kVertexOfAttribute * attributes);
}

// One of Draco's decoders that asks before it takes memory.
template <class Decoder>
class AskingDecoder : public Decoder {
 public:
  explicit AskingDecoder(const ExpectMemory& expect_memory) : expect_memory_(expect_memory) {}

  // What expect_memory has thrown: no exception goes through Draco.
  std::exception_ptr refusal() const { return refusal_; }

 protected:
  bool DecodeConnectivity() override {
    memory_ += memory_of_connectivity(*this, Peek(*this->buffer()));
    return may_go_on() && Decoder::DecodeConnectivity();
  }

  bool DecodeAllAttributes() override {
    constexpr std::uint64_t kOfEachValue = 8;  // its number, twice
    const std::uint64_t points = this->point_cloud()->num_points();
    for (int i = 0; i < this->point_cloud()->num_attributes(); ++i) {
      const draco::PointAttribute& attribute = *this->point_cloud()->attribute(i);
      // As it is, as whole numbers, and once more where it is handed on.
      memory_ += points * (2 * static_cast<std::uint64_t>(attribute.byte_stride()) +
                           sizeof(std::int32_t) * attribute.num_components() + kOfEachValue);
    }
    return may_go_on() && Decoder::DecodeAllAttributes();
  }

 private:
  bool may_go_on() {
    try {
      expect_memory_(memory_);
      return true;
    } catch (...) {
      refusal_ = std::current_exception();
      return false;
    }
  }

  const ExpectMemory& expect_memory_;
  std::uint64_t memory_ = 0;
  std::exception_ptr refusal_;
};

template <class Decoder>
void decode(std::string_view packed, const ExpectMemory& expect_memory, draco::Mesh& mesh) {
  AskingDecoder<Decoder> decoder(expect_memory);
  draco::DecoderBuffer buffer;
  buffer.Init(packed.data(), packed.size());
  const bool decoded = decoder.Decode(draco::DecoderOptions(), &buffer, &mesh).ok();
  if (decoder.refusal() != nullptr) {
    std::rethrow_exception(decoder.refusal());
  }
  if (!decoded) {
    throw InputError("holds a Draco mesh that is damaged");
  }
}

// The fixed part of the header: "DRACO", the version, the kind, the method and flags.
void decode_any(std::string_view packed, const ExpectMemory& expect_memory, draco::Mesh& mesh) {
  constexpr std::size_t kHeader = 11;
  if (packed.size() < kHeader || !packed.starts_with("DRACO")) {
    throw InputError("holds no Draco mesh");
  }
  constexpr unsigned char kMajor = 2, kMinor = 2, kMesh = 1, kMetadata = 0x80;
  const auto byte = [&](std::size_t at) { return static_cast<unsigned char>(packed[at]); };
  if (byte(5) != kMajor || byte(6) != kMinor) {
    throw InputError(fmt::format("holds a Draco mesh of version {}.{}; spincat reads 2.2", byte(5), byte(6)));
  }
  if (byte(7) != kMesh || byte(8) > draco::MESH_EDGEBREAKER_ENCODING) {
    throw InputError("holds something of Draco that is no mesh");
  }
  if ((byte(10) & kMetadata) != 0) {
    constexpr std::uint64_t kEntry = 30;  // bytes that an entry takes for each of its own
    expect_memory(kEntry * packed.size());
  }
  byte(8) == draco::MESH_SEQUENTIAL_ENCODING ? decode<draco::MeshSequentialDecoder>(packed, expect_memory, mesh)
                                             : decode<draco::MeshEdgebreakerDecoder>(packed, expect_memory, mesh);
}

// None where it must be written as float32.
std::optional<ScalarType> type_as_it_is(draco::DataType type) {
  switch (type) {
    case draco::DT_INT8:
      return ScalarType::int8;
    case draco::DT_UINT8:
    case draco::DT_BOOL:
      return ScalarType::uint8;
    case draco::DT_INT16:
      return ScalarType::int16;
    case draco::DT_UINT16:
      return ScalarType::uint16;
    case draco::DT_UINT32:
      return ScalarType::uint32;
    case draco::DT_FLOAT32:
      return ScalarType::float32;
    default:
      return std::nullopt;
  }
}

DracoAttribute attribute_of(const draco::Mesh& mesh, const std::string& name, std::uint32_t id) {
  const draco::PointAttribute* found = mesh.GetAttributeByUniqueId(id);
  if (found == nullptr) {
    throw InputError(fmt::format("holds a Draco mesh without the attribute {} ({})", id, in_quotes(name)));
  }
  const std::optional<ScalarType> type = type_as_it_is(found->data_type());
  if (!type) {
    throw InputError(fmt::format("holds a Draco mesh whose attribute {} ({}) has numbers of the type {}", id,
                                 in_quotes(name), static_cast<int>(found->data_type())));
  }
  DracoAttribute attribute{*type, found->num_components(), {}};
  const std::size_t size = size_of(*type) * attribute.components;
  attribute.values.reserve(size * mesh.num_points());
  for (draco::PointIndex i(0); i < mesh.num_points(); ++i) {
    const draco::AttributeValueIndex value = found->mapped_index(i);
    if (value.value() >= found->size() || !found->IsAddressValid(found->GetAddress(value) + size - 1)) {
      throw InputError("holds a Draco mesh that is damaged");
    }
    attribute.values.append(reinterpret_cast<const char*>(found->GetAddress(value)), size);
  }
  return attribute;
}

}  // namespace

bool has_draco() {
  return true;
}

DracoMesh unpack_draco(std::string_view packed, const std::map<std::string, std::uint32_t>& wanted,
                       const ExpectMemory& expect_memory) {
  draco::Mesh mesh;
  decode_any(packed, expect_memory, mesh);
  DracoMesh result{mesh.num_points(), mesh.num_faces(), {}, {}};
  result.corners.reserve(result.triangles * 3 * sizeof(std::uint32_t));
  for (draco::FaceIndex i(0); i < mesh.num_faces(); ++i) {
    for (const draco::PointIndex& corner : mesh.face(i)) {
      const std::uint32_t index = corner.value();
      result.corners.append(reinterpret_cast<const char*>(&index), sizeof(index));
    }
  }
  for (const auto& [name, id] : wanted) {
    result.attributes.emplace(name, attribute_of(mesh, name, id));
  }
  return result;
}

#else

bool has_draco() {
  return false;
}

DracoMesh unpack_draco(std::string_view, const std::map<std::string, std::uint32_t>&,
                       const std::function<void(std::uint64_t)>&) {
  throw InputError("is compressed with Draco, which this spincat was built without (scripts/setup installs it)");
}

#endif

}  // namespace spincat::io
