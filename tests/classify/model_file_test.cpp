#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <nlohmann/json.hpp>
#include <string>

#include "spincat/classify/model.h"
#include "spincat/classify/model_data.h"
#include "spincat/files/file.h"
#include "spincat/files/record_file.h"
#include "spincat/settings/settings_json.h"
#include "support/expect_error.h"
#include "support/float_blob.h"
#include "support/record_bytes.h"
#include "support/temp_dir.h"

namespace spincat {
namespace {

using test::input_error;
using test::TempDir;
using Json = nlohmann::json;

// Three categories, judges of five features.
ModelData small_model() {
  ModelData model;
  model.settings = preset("default");
  model.settings.seed = 77;
  model.categories = {"chair", "table", "\xC3\xA9tag\xC3\xA8re"};
  model.judges.categories = 3;
  model.judges.weights.resize(3, 5);
  for (Eigen::Index l = 0; l < 3; ++l) {
    for (Eigen::Index d = 0; d < 5; ++d) {
      model.judges.weights(l, d) = 0.1F * static_cast<float>(l) - 0.37F * static_cast<float>(d);
    }
  }
  model.judges.bias = Eigen::Vector3f(0.1F, -0.0F, std::numeric_limits<float>::denorm_min());
  model.judges.support_vectors = {4, 5, 6};
  model.calibration = {1.0 / 3.0, -0.2};
  FeatureMatrix map(5, 7);
  for (Eigen::Index i = 0; i < 35; ++i) {
    map(i / 7, i % 7) = 0.3F * static_cast<float>(i % 4) - 0.1F;
  }
  model.judges.whitening = Whitening(LearnedWhitening{map, Eigen::RowVectorXf::LinSpaced(5, -1.0F, 1.1F)});
  model.known.weights = Eigen::RowVectorXf::LinSpaced(5, 0.1F, -0.7F);
  model.known.bias = 0.3F;
  model.known.scaling = {1.5, 0.1};
  model.known.least = 0.25;
  model.dataset = "a \"data\" set";
  model.object_counts = {7, 8, 9};
  model.kinds = {20, 4};
  model.made_by = "spincat 0.1.0";
  return model;
}

std::string bytes_of(const Model& model) {
  const TempDir dir;
  write_model(dir / "m.spincat", model);
  return read_file(dir / "m.spincat");
}

// The same categories, rbf judges that lean on four objects of five features.
ModelData rbf_model() {
  ModelData model = small_model();
  model.settings.judge.kernel = KernelKind::rbf;
  model.settings.judge.dimensions = 0;
  model.judges.whitening = {};
  model.known = {};
  model.judges.kernel = {KernelKind::rbf, {2, 3}, {0.5F, 0.0F}};
  model.judges.supports.resize(4, 5);
  model.judges.weights.resize(3, 4);
  for (Eigen::Index i = 0; i < 20; ++i) {
    model.judges.supports.data()[i] = 0.1F * static_cast<float>(i);
  }
  for (Eigen::Index i = 0; i < 12; ++i) {
    model.judges.weights.data()[i] = 1.0F - 0.3F * static_cast<float>(i);
  }
  return model;
}

// The same with a codebook of five words of two numbers.
ModelData bag_model() {
  ModelData model = small_model();
  model.settings.encoding = "bag-of-features";
  model.settings.plain_samples = false;
  model.settings.radial = false;
  model.settings.judge.dimensions = 0;
  model.judges.whitening = {};
  model.known = {};
  model.judges.codebook.words.resize(5, 2);
  model.judges.codebook.words << 0, 1, 2, 3, 4, 5, 6, 7, 8, 9;
  return model;
}

const std::string& small_bytes() {
  static const std::string bytes = bytes_of(small_model());
  return bytes;
}

Json small_content() {
  return unpack_record(small_bytes(), "model", kModelVersion);
}

// What read_model says about such bytes, without the file's name.
std::string problem_with(const std::string& bytes) {
  const TempDir dir;
  const auto file = dir.write("m.spincat", bytes);
  try {
    read_model(file);
  } catch (const InputError& error) {
    EXPECT_EQ(error.file(), file.string());
    return error.problem();
  }
  return "no error";
}

// ... about a file of a right checksum whose content was changed.
std::string problem_after(const std::function<void(Json&)>& change) {
  Json content = small_content();
  change(content);
  return problem_with(test::record_bytes("model", kModelVersion, content));
}

TEST(ModelFile, RoundTripsExactly) {
  const ModelData model = small_model();
  const TempDir dir;
  write_model(dir / "m.spincat", model);
  const ModelData back = read_model(dir / "m.spincat").data();
  EXPECT_EQ(settings_to_json(back.settings), settings_to_json(model.settings));
  EXPECT_EQ(back.categories, model.categories);
  EXPECT_EQ(back.judges.categories, 3U);
  EXPECT_TRUE(back.judges.weights == model.judges.weights);
  EXPECT_TRUE(back.judges.bias == model.judges.bias);
  EXPECT_TRUE(std::signbit(back.judges.bias[1]));
  EXPECT_EQ(back.judges.support_vectors, model.judges.support_vectors);
  EXPECT_EQ(back.calibration.slope, model.calibration.slope);
  EXPECT_EQ(back.calibration.offset, model.calibration.offset);
  EXPECT_TRUE(std::ranges::equal(back.judges.whitening.columns.bits(), model.judges.whitening.columns.bits()));
  EXPECT_EQ(back.judges.whitening.middle, model.judges.whitening.middle);
  EXPECT_EQ(back.known.weights, model.known.weights);
  EXPECT_EQ(back.known.bias, model.known.bias);
  EXPECT_EQ(back.known.scaling.slope, model.known.scaling.slope);
  EXPECT_EQ(back.known.scaling.offset, model.known.scaling.offset);
  EXPECT_EQ(back.known.least, model.known.least);
  EXPECT_EQ(back.dataset, model.dataset);
  EXPECT_EQ(back.object_counts, model.object_counts);
  EXPECT_EQ(back.kinds.meshes, model.kinds.meshes);
  EXPECT_EQ(back.kinds.clouds, model.kinds.clouds);
  EXPECT_EQ(back.made_by, model.made_by);
  EXPECT_EQ(back.feature_length(), 7U);
  EXPECT_EQ(bytes_of(back), bytes_of(model));
}

TEST(ModelFile, EveryTruncationIsRefused) {
  const std::string& good = small_bytes();
  ASSERT_EQ(problem_with(good), "no error");
  for (std::size_t size = 0; size < good.size(); ++size) {
    EXPECT_NE(problem_with(good.substr(0, size)), "no error") << size;
  }
  EXPECT_NE(problem_with(good + '\0'), "no error");
}

TEST(ModelFile, EveryDamagedByteIsRefused) {
  const std::string& good = small_bytes();
  for (std::size_t at = 0; at < good.size(); ++at) {
    std::string bad = good;
    bad[at] = static_cast<char>(bad[at] ^ (1 << at % 8));
    EXPECT_NE(problem_with(bad), "no error") << at;
  }
}

TEST(ModelFile, WhatIsNoModelIsRefused) {
  EXPECT_EQ(problem_with("OFF\n0 0 0\n"), "is not a spincat file");
  EXPECT_EQ(problem_with(""), "is not a spincat file");
  EXPECT_NE(problem_with(test::record_bytes("features", 1, small_content())).find("features"), std::string::npos);
  EXPECT_NE(problem_with(test::record_bytes("model", kModelVersion + 1, {})).find("newer spincat"), std::string::npos);
  const TempDir dir;
  EXPECT_NE(input_error([&] { read_model(dir / "none"); }).find("none"), std::string::npos);
}

TEST(ModelFile, AnotherVersionIsNamed) {
  EXPECT_EQ(problem_with(test::record_bytes("model", 2, small_content())),
            "was written by an older spincat (model format 2, this one reads from 3 on)");
  EXPECT_EQ(problem_with(test::record_bytes("model", 4, small_content())),
            "was written by a newer spincat (model format 4, this one reads up to 3)");
}

TEST(ModelFile, AMissingMemberIsNamed) {
  for (const char* name :
       {"settings", "categories", "judges", "calibration", "dataset", "object_counts", "kinds", "made_by"}) {
    EXPECT_EQ(problem_after([&](Json& json) { json.erase(name); }), "model: '" + std::string(name) + "' is missing");
  }
  for (const char* name : {"features", "weights", "bias", "support_vectors"}) {
    EXPECT_EQ(problem_after([&](Json& json) { json["judges"].erase(name); }),
              "model: '" + std::string(name) + "' is missing");
  }
  for (const char* name : {"slope", "offset"}) {
    EXPECT_EQ(problem_after([&](Json& json) { json["calibration"].erase(name); }),
              "model: '" + std::string(name) + "' is missing");
  }
  EXPECT_NE(problem_with(test::record_bytes("model", kModelVersion, Json::array({1, 2, 3}))), "no error");
}

TEST(ModelFile, AMemberOfTheWrongTypeIsRefused) {
  for (const char* name :
       {"settings", "categories", "judges", "calibration", "dataset", "object_counts", "kinds", "made_by"}) {
    for (const Json& wrong : {Json(nullptr), Json(1), Json(true), Json::array({Json::array()})}) {
      EXPECT_NE(problem_after([&](Json& json) { json[name] = wrong; }), "no error") << name << " = " << wrong;
    }
  }
  for (const char* name : {"features", "weights", "bias", "support_vectors"}) {
    for (const Json& wrong : {Json(nullptr), Json("5"), Json(true), Json(5.5), Json::array({1.5, 2.5, 3.5})}) {
      EXPECT_NE(problem_after([&](Json& json) { json["judges"][name] = wrong; }), "no error") << name << " = " << wrong;
    }
  }
  for (const Json& wrong : {Json(nullptr), Json("5"), Json(true)}) {
    EXPECT_NE(problem_after([&](Json& json) { json["calibration"]["slope"] = wrong; }), "no error") << wrong;
  }
}

TEST(ModelFile, HostileCategoriesAreRefused) {
  for (const Json& names : {Json::array(), Json::array({"chair"}), Json::array({"a", "b", "a"}),
                            Json::array({"a", "b"}), Json::array({"a", "b", "c", "d"}), Json::array({"a", "", "b"})}) {
    EXPECT_NE(problem_after([&](Json& json) { json["categories"] = names; }), "no error") << names;
  }
}

TEST(ModelFile, HostileJudgesAreRefused) {
  const auto problem_of = [](const char* name, const Json& value) {
    return problem_after([&](Json& json) { json["judges"][name] = value; });
  };
  EXPECT_EQ(problem_of("features", 0), "model: 'features' is not a whole number from 1 to 100000000");
  EXPECT_NE(problem_of("features", -1), "no error");
  EXPECT_NE(problem_of("features", 5.5), "no error");
  EXPECT_NE(problem_of("features", 6), "no error");
  EXPECT_NE(problem_of("features", std::numeric_limits<std::uint64_t>::max()), "no error");
  EXPECT_NE(problem_of("features", (std::uint64_t{1} << 62) + 5), "no error");  // 4 * 3 * this wraps around
  EXPECT_EQ(problem_of("weights", test::float_blob(std::vector<float>(14))), "model: 'weights' is of the wrong size");
  EXPECT_NE(problem_of("weights", test::float_blob(std::vector<float>(16))), "no error");
  EXPECT_EQ(problem_of("bias", test::float_blob({1, 2})), "model: 'bias' does not hold 3 numbers");
  EXPECT_EQ(problem_of("bias", test::float_blob({1, 2, 3, 4})), "model: 'bias' does not hold 3 numbers");
  const float nan = std::numeric_limits<float>::quiet_NaN();
  EXPECT_EQ(problem_of("bias", test::float_blob({1, nan, 3})), "model: 'bias' holds a number that is not finite");
  EXPECT_EQ(problem_of("weights", test::float_blob(std::vector<float>(15, std::numeric_limits<float>::infinity()))),
            "model: 'weights' holds a number that is not finite");
  EXPECT_EQ(problem_of("weights", test::float_blob(std::vector<float>(15, 3e38F))),
            "model: 'weights' holds 3e+38, which no training gives");
  EXPECT_NE(problem_of("support_vectors", Json::array({1, 2})), "no error");
  EXPECT_NE(problem_of("support_vectors", Json::array({1, -2, 3})), "no error");
  EXPECT_NE(problem_of("support_vectors", Json::array({1, 2, std::int64_t{1} << 32})), "no error");
}

TEST(ModelFile, RbfJudgesRoundTripExactly) {
  const ModelData model = rbf_model();
  const TempDir dir;
  write_model(dir / "m.spincat", model);
  const ModelData back = read_model(dir / "m.spincat").data();
  EXPECT_EQ(back.judges.kernel.kind, KernelKind::rbf);
  EXPECT_EQ(back.judges.kernel.block_sizes, model.judges.kernel.block_sizes);
  EXPECT_EQ(back.judges.kernel.scale, model.judges.kernel.scale);
  EXPECT_TRUE(back.judges.supports == model.judges.supports);
  EXPECT_TRUE(back.judges.weights == model.judges.weights);
  EXPECT_EQ(back.feature_length(), 5U);
  EXPECT_EQ(bytes_of(back), bytes_of(model));
}

TEST(ModelFile, HostileRbfJudgesAreRefused) {
  const Json good = unpack_record(bytes_of(rbf_model()), "model", kModelVersion);
  const auto problem_of = [&](const char* name, const Json& value) {
    Json content = good;
    content["judges"][name] = value;
    return problem_with(test::record_bytes("model", kModelVersion, content));
  };
  ASSERT_EQ(problem_of("features", 5), "no error");
  EXPECT_EQ(problem_of("features", 4), "model: 'blocks' add up to 5, not to 4 features");
  EXPECT_EQ(problem_of("blocks", Json::array({2, 2})), "model: 'blocks' add up to 4, not to 5 features");
  EXPECT_EQ(problem_of("blocks", Json::array({5, 0})), "model: 'blocks' has an empty block");
  for (const Json& wrong :
       {Json(nullptr), Json(5), Json::array(), Json::array({5}), Json::array({-2, 7}), Json::array({2.5, 2.5}),
        Json::array({1, 1, 1, 1, 1, 0}), Json::array({std::int64_t{1} << 32, 5})}) {
    EXPECT_NE(problem_of("blocks", wrong), "no error") << wrong;
  }
  EXPECT_EQ(problem_of("scale", test::float_blob({1, -1})), "model: 'scale' holds a number below 0");
  EXPECT_EQ(problem_of("scale", test::float_blob({1})), "model: 'scale' does not hold 2 numbers");
  EXPECT_NE(problem_of("scale", test::float_blob({1, std::numeric_limits<float>::quiet_NaN()})), "no error");
  EXPECT_EQ(problem_of("supports", test::float_blob(std::vector<float>(19))), "model: 'supports' is of the wrong size");
  EXPECT_EQ(problem_of("supports", test::float_blob({})), "model: 'supports' is of the wrong size");
  EXPECT_NE(problem_of("supports", test::float_blob(std::vector<float>(25))),
            "no error");  // more than the weights know
  EXPECT_NE(problem_of("supports", Json(1)), "no error");
  EXPECT_EQ(problem_of("weights", test::float_blob(std::vector<float>(8))), "model: 'weights' is of the wrong size");
  EXPECT_NE(problem_of("weights", test::float_blob(std::vector<float>(13))), "no error");
  for (const char* name : {"blocks", "scale", "supports"}) {
    Json content = good;
    content["judges"].erase(name);
    EXPECT_EQ(problem_with(test::record_bytes("model", kModelVersion, content)),
              "model: '" + std::string(name) + "' is missing");
  }
}

TEST(ModelFile, ACodebookRoundTripsExactly) {
  const ModelData model = bag_model();
  const TempDir dir;
  write_model(dir / "m.spincat", model);
  const ModelData back = read_model(dir / "m.spincat").data();
  EXPECT_TRUE(back.judges.codebook.words == model.judges.codebook.words);
  EXPECT_EQ(back.feature_length(), 2U * kLocalFeatures);
  EXPECT_EQ(bytes_of(back), bytes_of(model));
}

TEST(ModelFile, AHostileCodebookIsRefused) {
  const Json good = unpack_record(bytes_of(bag_model()), "model", kModelVersion);
  const auto problem_of = [&](const std::function<void(Json&)>& change) {
    Json content = good;
    change(content);
    return problem_with(test::record_bytes("model", kModelVersion, content));
  };
  ASSERT_EQ(problem_of([](Json&) {}), "no error");
  for (const Json& wrong : {Json(0), Json(-2), Json(2.5), Json("2"), Json(std::uint64_t{1} << 62), Json(3)}) {
    EXPECT_NE(problem_of([&](Json& json) { json["judges"]["local_size"] = wrong; }), "no error") << wrong;
  }
  for (const std::size_t size : {0, 8, 9, 12}) {
    EXPECT_NE(problem_of([&](Json& json) { json["judges"]["codebook"] = test::float_blob(std::vector<float>(size)); }),
              "no error");
  }
  EXPECT_EQ(problem_of([](Json& json) {
              json["judges"]["codebook"] =
                  test::float_blob(std::vector<float>(10, std::numeric_limits<float>::infinity()));
            }),
            "model: 'codebook' holds a number that is not finite");
  EXPECT_EQ(problem_of([](Json& json) { json["judges"].erase("local_size"); }), "model: 'local_size' is missing");
  EXPECT_EQ(problem_of([](Json& json) { json["judges"].erase("codebook"); }),
            "model: a codebook is missing for the encoding bag-of-features");
  EXPECT_EQ(problem_of([](Json& json) { json["settings"]["encoding"] = "pooled-pyramid"; }),
            "model: a codebook is not expected for the encoding pooled-pyramid");
}

TEST(ModelFile, HostileCountsAreRefused) {
  for (const Json& counts : {Json::array({1, 2}), Json::array({1, 2, 3, 4}), Json::array({1, -2, 3}),
                             Json::array({1, 2, std::int64_t{1} << 32}), Json::array({1, 2.5, 3})}) {
    EXPECT_NE(problem_after([&](Json& json) { json["object_counts"] = counts; }), "no error") << counts;
  }
}

TEST(ModelFile, AHostileCalibrationIsRefused) {
  for (const double bad : {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity(), -1e300}) {
    EXPECT_EQ(problem_after([&](Json& json) { json["calibration"]["slope"] = bad; }),
              "model: 'calibration' is not finite, or too large");
    EXPECT_EQ(problem_after([&](Json& json) { json["calibration"]["offset"] = bad; }),
              "model: 'calibration' is not finite, or too large");
  }
}

TEST(ModelFile, HostileSettingsAreRefused) {
  EXPECT_EQ(problem_after([](Json& json) { json["settings"]["points"] = -1; }), "points -1: expected 1 to 10,000,000");
  EXPECT_EQ(problem_after([](Json& json) { json["settings"]["points"] = 10'000'000; }),
            "10000256 points and spin points over all draws: judges take at most 4000000 of an object");
}

TEST(ModelFile, AHostileSpaceIsRefused) {
  const auto problem_of = [](const char* name, const Json& value) {
    return problem_after([&](Json& json) { json["judges"][name] = value; });
  };
  const auto halves = [](std::size_t count, std::uint8_t high) {
    Json::binary_t::container_type bytes(2 * count);
    for (std::size_t i = 1; i < bytes.size(); i += 2) {
      bytes[i] = high;
    }
    return Json::binary(std::move(bytes));
  };
  EXPECT_EQ(problem_of("map", halves(35, 0x3C)), "no error");
  EXPECT_EQ(problem_of("map", halves(34, 0x3C)), "model: 'map' is of the wrong size");
  EXPECT_EQ(problem_of("map", halves(35, 0x7C)), "model: 'map' holds a number that is not finite");
  EXPECT_EQ(problem_of("inputs", 6), "model: 'map' is of the wrong size");
  EXPECT_EQ(problem_of("inputs", ~std::uint64_t{0}), "model: 'map' is of the wrong size");
  EXPECT_EQ(problem_of("inputs", -7), "model: 'map' is of the wrong size");
  EXPECT_EQ(problem_of("middle", test::float_blob({1, 2})), "model: 'middle' does not hold 5 numbers");
  EXPECT_EQ(problem_after([](Json& json) { json["judges"].erase("map"); }),
            "model: a space that judges learn in is missing");
  EXPECT_EQ(problem_after([](Json& json) { json["settings"]["dimensions"] = 0; }),
            "model: a space that judges learn in is not expected");
}

TEST(ModelFile, AHostileJudgeOfStrangersIsRefused) {
  const auto problem_of = [](const char* name, const Json& value) {
    return problem_after([&](Json& json) { json["known"][name] = value; });
  };
  EXPECT_EQ(problem_of("weights", test::float_blob({1, 2})), "model: 'weights' does not hold 5 numbers");
  EXPECT_EQ(problem_of("least", 1.5), "model: 'known' holds a number out of range");
  EXPECT_EQ(problem_of("least", std::numeric_limits<double>::quiet_NaN()),
            "model: 'known' holds a number out of range");
  EXPECT_EQ(problem_of("bias", 1e37), "model: 'known' holds a number out of range");
  EXPECT_EQ(problem_of("scaling", Json(1)), "model: 'slope' is missing");
}

TEST(IsModelFile, LooksAtTheFirstBytes) {
  const TempDir dir;
  EXPECT_TRUE(is_model_file(dir.write("m", small_bytes())));
  EXPECT_TRUE(is_model_file(dir.write("m", "SPINCAT\x1A")));
  EXPECT_FALSE(is_model_file(dir.write("m", "SPINCAT")));
  EXPECT_FALSE(is_model_file(dir.write("m", "OFF 1 2 3 4 5 6")));
  EXPECT_FALSE(is_model_file(dir / "none"));
  EXPECT_FALSE(is_model_file(dir.path()));
}

}  // namespace
}  // namespace spincat
