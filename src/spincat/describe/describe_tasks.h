// Describing the objects of a data set, or files to be named, on all threads and ranks of a farm.
#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "spincat/describe/dense_object.h"
#include "spincat/describe/describe.h"
#include "spincat/describe/feature_bytes.h"
#include "spincat/describe/kinds.h"
#include "spincat/describe/table_rows.h"
#include "spincat/encode/feature_vector.h"
#include "spincat/geometry/object.h"
#include "spincat/io/read_limits.h"
#include "spincat/judge/gram.h"
#include "spincat/parallel/task.h"
#include "spincat/parallel/task_farm.h"
#include "spincat/settings/settings.h"

namespace spincat {

// The name of this kind of work, as ranks tell each other.
inline constexpr const char* kDescribeTasks = "feature vectors of objects";

// What became of one file.
struct Described {
  std::vector<FeatureVector> features;  // the object itself and its copies; empty when it could not be read
  std::string problem;                  // why not
  bool lacks_memory = false;            // that is why
  ObjectKind kind = ObjectKind::mesh;   // where it could be read
  StageSeconds seconds;
};

// Directions (M x D) along which features are handed on as M coordinates, where D numbers of every row are too many to
// keep; none: the features themselves.
using FeatureBasis = std::shared_ptr<const FeatureMatrix>;

// The features of an object as coordinates; where there are not D of them that is its problem.
void project(const FeatureMatrix& basis, Described& described);

// Describes one object: `read` gives it, and `describe_row` describes its rows, the first of which is the object itself
// (or its first view). What is wrong with the object becomes its problem; so does memory that does not suffice for it.
// All other errors are thrown.
using DescribeRow = std::function<FeatureVector(const Object& object, int row, StageSeconds& seconds)>;
Described describe_object(const std::function<Object()>& read, int rows, const DescribeRow& describe_row);

// Row k is training copy k (training_copies.h). What is passed by reference must outlive the result.
DescribeRow describe_copies(const Settings& settings, const EncodePrepared& encoder = {});

// As a task's result.
std::string pack(const Described& described);
Described unpack_described(std::string_view bytes);

// The same, but for the numbers of the feature vectors, which stay in `bytes`: those of `head` are empty.
struct PackedDescribed {
  Described head;
  std::vector<FeatureBytes> values;
};
PackedDescribed view_described(std::string_view bytes);

// Throws RunError, with the file, where a number is not finite: no object has such features.
void check_finite(const PackedDescribed& described, const std::filesystem::path& file);

// Which files, and how.
struct DescribeJob {
  std::size_t files = 0;
  std::function<const std::filesystem::path&(std::size_t)> file;
  const Settings& settings;
  int views = 1;  // the object itself and views - 1 training copies
  WorkSplit split = WorkSplit::encode_remotely;
  ReadLimits limits = {};
  // Asked with the length of the first feature vector: whether all ranks keep all of them (TableRows). Not asked
  // where spin points are shared out. Empty: no.
  std::function<bool(std::size_t length)> keeps_rows;
  FeatureBasis basis = {};
};

// Reads and describes every file and hands the results on in order, on the calling thread. Many objects with few spin
// points are shared out object by object; those with many spin points, or all of them where the split is
// `return_images`, one after the other by their spin points. The results are the same for any number of threads and
// ranks and for both splits; the seconds are not. The numbers of the feature vectors are only there while they are
// delivered, and only in `values`. `tick` gets the number of files that are done.
using DeliverDescribed =
    std::function<void(std::size_t i, const Described& described, std::span<const FeatureBytes> values)>;
void describe_files(TaskFarm& farm, const DescribeJob& job, const DeliverDescribed& deliver,
                    const TaskFarm::Tick& tick);

// Whether objects are dealt with one after the other, each shared out by its spin points: where they have many, or
// where the split asks for it.
bool spreads_points(const Settings& settings, WorkSplit split);

// For describe(): shares out the spin points of a prepared object. What is referred to must outlive the result.
EncodePrepared encode_on(TaskFarm& farm, const Settings& settings, WorkSplit split, const TaskFarm::Tick& tick);

// Its work, for other ranks, which keep the feature vectors in `rows` where they are asked to; `make_room` is called
// before that, as both the old table and the new rows may be too much.
RankWork make_describe_work(std::string_view context, std::optional<TableRows>& rows,
                            const std::function<void()>& make_room);

}  // namespace spincat
