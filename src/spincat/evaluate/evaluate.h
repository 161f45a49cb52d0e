// Measuring: how often the judges are right on objects that they were not trained on.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "spincat/dataset/dataset.h"
#include "spincat/describe/describe.h"
#include "spincat/evaluate/rates.h"
#include "spincat/execution.h"
#include "spincat/settings/settings.h"

#pragma GCC visibility push(default)
namespace spincat {

// Which objects are learned from and which are tested.
enum class Protocol {
  splits,         // repeated stratified random splits of one data set
  leave_one_out,  // each object by judges that were trained on all others
  across,         // all objects of another data set (or of the data set's own test part), once
};

// How objects are shown to the judges. A cloud stays a cloud: as a mesh with noise it only gets noise, as one with
// holes or inner faces it is an error.
enum class TestForm {
  as_is,
  turned,      // turned at random, evenly over all rotations
  cloud,       // points drawn evenly from the surface, without normals, with noise
  noisy_mesh,  // vertices moved by noise, those at one place together
  dense_mesh,  // edges halved, the longest first, until there are 8,000 triangles; then vertices moved by noise
  holes,   // faces taken away at random until a fifth of the area is gone; edges are at most a tenth of the diameter
  inner,   // 30 random boxes and plates added in the middle 80 % of the bounding box
  cut,     // a cloud without the 30 % of its points that lie beyond a plane of random direction
  sparse,  // a cloud of few points
};

// As options and JSON spell it: "noisy-mesh".
std::string_view name_of(TestForm form);
// Throws InputError that lists the names when there is none.
TestForm test_form_named(std::string_view name);

struct TestOptions {
  TestForm form = TestForm::as_is;
  // Of clouds and moved vertices: standard deviation along each axis, in diameters of the object, 0 to 1; the diameter
  // is twice the distance of the furthest point from the centre of the bounding box. None means what suits the form:
  // .01 for cloud and dense_mesh, .005 for noisy_mesh, 0 for cut and sparse.
  std::optional<double> noise;
  // Of clouds, 1 to 10,000,000. None means 300 for sparse, else 2,048.
  std::optional<int> cloud_points;

  double used_noise() const;
  int used_cloud_points() const;
  // Whether they change anything.
  bool has_noise() const;
  bool has_cloud_points() const;

  // Throws InputError naming the option, its value and the allowed range.
  void validate() const;
};

struct EvaluateOptions {
  bool leave_one_out = false;
  int splits = 20;                         // for each seed, 1 to 10,000
  double test_share = 0.2;                 // of each category's objects, more than 0 and less than 1
  std::vector<std::uint64_t> split_seeds;  // of the splits; none means Settings::seed. Everything else that is random
                                           // (points, copies) follows Settings::seed alone, so that objects are
                                           // described once for all splits of all seeds
  int fewest_objects = 1;                  // categories with fewer objects to learn from are left out, 1 to 1,000,000
  TestOptions test;                        // how the tested objects are shown
  bool measure_confidence = false;         // calibrates in each split, too: six times the training
  std::vector<std::filesystem::path> unknown_objects;  // files of objects of none of the categories; asks for the above

  // Throws InputError naming the option, its value and the allowed range.
  void validate() const;
  bool calibrates() const { return measure_confidence || !unknown_objects.empty(); }
};

// The rates over the splits of one seed.
struct SeedRates {
  std::uint64_t seed = 0;
  Rate mean_class_rate;
  Rate overall_rate;
};

// What the confidence tells, as areas under the curve (roc.h). Confidences are of the judges of each split in objects
// that they were not trained on.
struct ConfidenceMeasure {
  double right_or_wrong = 0.5;    // tested objects named right against those named wrong, of all splits together
  double known_or_unknown = 0.5;  // by how known they are: tested objects against unknown objects, the mean over splits
  double mean_confidence = 0.0;   // over the tested objects of all splits; close to their overall rate when calibrated
  std::uint32_t unknown_objects = 0;  // how many could be read, each counted by its views
  double turned_away = 0.0;           // the share of tested objects that classify calls unknown; the rates above are of
                                      // the names that it would give them
  double strangers_turned_away = 0.0;  // the share of unknown objects
};

// Rates by the number of views of an object over which votes are summed.
struct ViewsRates {
  std::uint32_t views = 1;
  double mean_class_rate = 0.0;  // over the splits the mean
  double overall_rate = 0.0;
};

// A tested object and what it was named.
struct TestedObject {
  std::filesystem::path file;
  std::uint32_t category = 0;        // the truth
  std::vector<std::uint32_t> named;  // the category it was given, in each split that tested it; maybe in none
};

struct Evaluation {
  std::string dataset;
  std::string test_dataset;  // empty when the data set is its own
  Protocol protocol = Protocol::splits;
  std::vector<std::string> categories;            // n
  std::vector<std::uint32_t> object_counts;       // n: objects of each category to learn from (and to test)
  std::vector<std::uint32_t> test_object_counts;  // n, with Protocol::across; else empty
  std::string list_checksum;                      // parts.h
  std::string test_list_checksum;
  std::vector<LeftOutCategory> left_out;
  std::vector<SkippedObject> skipped;
  int splits = 0;                          // for each seed; 1 with the other protocols
  std::vector<std::uint64_t> split_seeds;  // empty with the other protocols
  Rate mean_class_rate;  // the mean of the confusion matrix's diagonal, each row as shares (the paper's figure)
  Rate overall_rate;     // right votes over all votes
  std::vector<Rate> category_rates;  // n: over the splits that tested the category
  std::vector<SeedRates> seeds;      // with Protocol::splits
  std::vector<ViewsRates> views;     // with TrainedFor::views: 1, 2, 4, ... and all views; the rates above are of all
  Confusion confusion;               // added up over the splits
  std::vector<TestedObject> tested;  // all that could be, in the order of the data set: confusion[i][j] is how often
                                     // objects of category i were named j
  std::optional<ConfidenceMeasure> confidence;
  std::string kind_mismatch;  // why the judges should not be trusted with the tested objects (kinds.h); mostly empty
  StageSeconds seconds;       // added up over threads; judge: training and voting
  double wall_seconds = 0.0;  // of everything
};

// Describes every object of the data set once, and again in the form it is tested in where that is another. Then
// trains the judges of each split on the training objects and their copies, and lets them vote on the test objects.
// The result is the same for the same data, settings and options, whatever the execution. A category with a single
// object is never tested by splits; leaving that object out tests the judges of the other categories on it. Intervals:
// over splits as rate_over_splits, otherwise as the pooled rates (rates.h).
// Throws InputError when options or settings are out of range, or fewer than two categories can be read.
Evaluation evaluate(const Dataset& dataset, const Settings& settings, const EvaluateOptions& options,
                    const Execution& execution = {});

// The same for judges that learn from one data set and are tested on another. Categories are matched by their names;
// those missing on either side are left out. Throws InputError besides when they share fewer than two, or when a file
// is in both.
Evaluation evaluate_across(const Dataset& train, const Dataset& test, const Settings& settings,
                           const EvaluateOptions& options, const Execution& execution = {});

}  // namespace spincat
#pragma GCC visibility pop
