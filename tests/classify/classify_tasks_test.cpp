#include <gtest/gtest.h>

#include "spincat/classify/classify.h"
#include "spincat/dataset/dataset.h"
#include "spincat/evaluate/evaluate.h"
#include "spincat/evaluate/evaluation_data.h"
#include "spincat/parallel/journal.h"
#include "spincat/parallel/task_farm.h"
#include "spincat/train/train.h"
#include "support/tiny_dataset.h"

namespace spincat {
namespace {

// What could not be read, or had not enough memory, may go well the next time.
TEST(ClassifyFiles, ProblemsAreInNoJournal) {
  test::TempDir dir;
  test::write_tiny_shapes(dir, "shapes", 4);
  const Model model = train(read_dataset({dir / "shapes"}), test::tiny_settings(), {}).model;
  dir.write("shapes/box/broken.off", "OFF\nnothing");
  const Dataset shapes = read_dataset({dir / "shapes"});
  ASSERT_EQ(shapes.objects.size(), 13U);
  Journal journal(dir / "j", {"settings", "data"});
  LocalFarm own(1);
  own.farm().use_journal(&journal);
  std::vector<std::filesystem::path> files;
  for (const DatasetObject& object : shapes.objects) {
    files.push_back(object.file);
  }
  const Execution execution{.farm = &own.farm()};
  std::size_t problems = 0;
  classify_files(model, files, execution,
                 [&](std::size_t, const Answer& answer) { problems += answer.error.empty() ? 0 : 1; });
  EXPECT_EQ(problems, 1U);
  EXPECT_EQ(journal.size(), 12U);
  EvaluateOptions options;
  options.test.form = TestForm::turned;
  BroadcastRows rows;
  describe_for_evaluation(shapes, test::tiny_settings(), options, execution, rows);
  EXPECT_EQ(journal.size(), 3U * 12U);  // to learn from, and as they are tested
}

}  // namespace
}  // namespace spincat
