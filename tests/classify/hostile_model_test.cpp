// Model files made to do harm: right in length and checksum, wrong in what they hold.
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <zlib.h>

#include <cmath>
#include <functional>
#include <limits>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "spincat/classify/classify.h"
#include "spincat/classify/model.h"
#include "spincat/classify/model_data.h"
#include "spincat/error.h"
#include "spincat/files/file.h"
#include "spincat/files/record_file.h"
#include "support/expect_error.h"
#include "support/float_blob.h"
#include "support/record_bytes.h"
#include "support/temp_dir.h"

namespace spincat {
namespace {

using Json = nlohmann::json;
using test::input_error;
using test::TempDir;

// Two categories, judges of three features.
ModelData small_model() {
  ModelData model;
  model.settings = preset("default");
  model.categories = {"chair", "table"};
  model.judges.categories = 2;
  model.judges.weights.resize(1, 3);
  model.judges.weights << 1.0F, -2.0F, 0.5F;
  model.judges.bias = Eigen::VectorXf::Constant(1, 0.25F);
  model.judges.support_vectors = {2};
  model.calibration = {1.5, -0.2};
  model.judges.whitening =
      Whitening(LearnedWhitening{FeatureMatrix::Identity(3, 4), Eigen::RowVectorXf::Constant(3, 0.5F)});
  model.known.weights = Eigen::RowVectorXf::LinSpaced(3, 0.1F, -0.7F);
  model.dataset = "data";
  model.object_counts = {2, 1};
  model.kinds = {3, 0};
  model.made_by = "spincat 0.1.0";
  return model;
}

Json content_of(const Model& model) {
  const TempDir dir;
  write_model(dir / "m.spincat", model);
  return unpack_record(read_file(dir / "m.spincat"), "model", kModelVersion);
}

// What read_model says about a file whose checksum is right and whose content was changed, without the file's name.
std::string problem_after(const std::function<void(Json&)>& change) {
  const TempDir dir;
  Json content = content_of(small_model());
  change(content);
  const auto file = dir.write("m.spincat", test::record_bytes("model", kModelVersion, content));
  const std::string line = input_error([&] { read_model(file); });
  const std::string name = file.string() + ": ";
  return line.starts_with(name) ? line.substr(name.size()) : line;
}

// All that naming an object does with a model once it has features.
void use(const ModelData& model) {
  const std::vector<float> features(model.feature_length(), 0.5F);
  const std::vector<float> seen = model.judges.seen(features);
  const Ballot ballot = model.judges.vote_on(seen);
  ASSERT_LT(ballot.winner, model.categories.size());
  for (const double p :
       {model.calibration.probability(static_cast<double>(ballot.weakest_margin)), model.known.known(seen)}) {
    EXPECT_TRUE(p >= 0.0 && p <= 1.0) << p;
  }
}

// Whoever changes a bit and mends the checksum gets a model that is refused in a line, or one that can be used.
TEST(HostileModel, EveryChangedBitIsRefusedOrHarmless) {
  const TempDir dir;
  write_model(dir / "m.spincat", small_model());
  const std::string good = read_file(dir / "m.spincat");
  const std::size_t head = std::string_view("SPINCAT\x1A").size() + 4 + std::string_view("model").size() + 4 + 8;
  const std::string content = good.substr(head, good.size() - head - 4);
  std::size_t refused = 0;
  for (std::size_t bit = 0; bit < 8 * content.size(); ++bit) {
    std::string changed = content;
    changed[bit / 8] = static_cast<char>(changed[bit / 8] ^ (1 << bit % 8));
    const std::string bytes = good.substr(0, head) + changed;
    const auto checksum =
        static_cast<std::uint32_t>(crc32_z(0, reinterpret_cast<const Bytef*>(bytes.data()), bytes.size()));
    const auto file =
        dir.write("changed.spincat", bytes + std::string(reinterpret_cast<const char*>(&checksum), sizeof(checksum)));
    try {
      use(read_model(file).data());
    } catch (const InputError& error) {
      EXPECT_EQ(error.file(), file.string());
      ++refused;
    }
  }
  EXPECT_GT(refused, 2 * content.size());
  EXPECT_LT(refused, 8 * content.size());
}

TEST(HostileModel, OneMadeForOtherCategoriesIsRefused) {
  EXPECT_EQ(problem_after([](Json& json) {
              json["categories"] = {"chair", "table", "lamp"};
            }),
            "model: 'weights' is of the wrong size");
  EXPECT_EQ(problem_after([](Json& json) { json["categories"] = {"chair"}; }),
            "model: 'categories' are not two or more different names");
  EXPECT_EQ(problem_after([](Json& json) {
              json["categories"] = {"chair", "chair"};
            }),
            "model: 'categories' are not two or more different names");
  EXPECT_EQ(problem_after([](Json& json) {
              json["object_counts"] = {1, 2, 3};
            }),
            "model: 'object_counts' does not hold 2 counts");
}

TEST(HostileModel, OneMadeForOtherSettingsIsRefused) {
  EXPECT_EQ(problem_after([](Json& json) { json["settings"]["encoding"] = "bag-of-features"; }),
            "the encoding bag-of-features knows no radial part, no plain samples, no up axis and only one draw");
  EXPECT_EQ(problem_after([](Json& json) { json["settings"]["encoding"] = "a\nb"; }),
            "setting 'encoding' is too long or not printable");
  EXPECT_EQ(problem_after([](Json& json) { json["settings"]["kernel"] = "rbf"; }),
            "dimensions need the linear kernel: rbf compares the features themselves");
  EXPECT_EQ(problem_after([](Json& json) {
              json["settings"]["kernel"] = "rbf";
              json["settings"]["dimensions"] = 0;
            }),
            "model: 'blocks' is missing");
  EXPECT_EQ(problem_after([](Json& json) { json["settings"].erase("views"); }), "setting 'views' is missing");
  // Settings and judges that do not belong together show when the first object is named.
  const Mesh mesh = {{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}, {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}}};
  const std::string line = input_error([&] { classify(small_model(), mesh); });
  EXPECT_NE(line.find("features where the model expects 4"), std::string::npos) << line;
}

// Sizes are compared with the bytes that are there before memory is taken for them.
TEST(HostileModel, HugeSizesAreRefused) {
  for (const std::uint64_t huge : {std::uint64_t{1} << 31, std::uint64_t{1} << 40, ~std::uint64_t{0}}) {
    EXPECT_NE(problem_after([&](Json& json) { json["judges"]["features"] = huge; }), "no error") << huge;
    EXPECT_NE(problem_after([&](Json& json) { json["settings"]["points"] = huge; }), "no error") << huge;
    EXPECT_NE(problem_after([&](Json& json) { json["settings"]["image_width"] = huge; }), "no error") << huge;
  }
  std::vector<std::string> names;
  for (int i = 0; i < 10'001; ++i) {
    names.push_back(fmt::format("category {}", i));
  }
  EXPECT_EQ(problem_after([&](Json& json) { json["categories"] = names; }),
            "model: 'categories' are not two or more different names");
}

TEST(HostileModel, DeepNestingIsRefused) {
  Json nested = 1;
  for (int i = 0; i < 31; ++i) {
    nested = Json::array({std::move(nested)});
  }
  EXPECT_EQ(problem_after([&](Json& json) { json["categories"] = nested; }),
            "model: 'categories' is of the wrong type");
}

}  // namespace
}  // namespace spincat
