#include "spincat/classify/classify_tasks.h"

#include <gtest/gtest.h>

#include "spincat/dataset/dataset.h"
#include "spincat/evaluate/evaluate.h"
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
  const std::filesystem::path model_file = dir / "shapes.spincat";
  const Model model = train(read_dataset({dir / "shapes"}), test::tiny_settings(), {}).model;
  dir.write("shapes/box/broken.off", "OFF\nnothing");
  const Dataset shapes = read_dataset({dir / "shapes"});
  ASSERT_EQ(shapes.objects.size(), 13U);
  Journal journal(dir / "j", {"settings", "data"});
  LocalFarm own(1);
  own.farm().use_journal(&journal);
  const ClassifyJob job{model, model_file, shapes.objects.size(),
                        [&](std::size_t i) -> const std::filesystem::path& { return shapes.objects[i].file; }};
  std::size_t problems = 0;
  classify_files(own.farm(), job, [&](std::size_t, const Answer& answer) { problems += answer.error.empty() ? 0 : 1; },
                 {});
  EXPECT_EQ(problems, 1U);
  EXPECT_EQ(journal.size(), 12U);
  EvaluateOptions options;
  options.farm = &own.farm();
  options.test.form = TestForm::turned;
  describe_for_evaluation(shapes, test::tiny_settings(), options);
  EXPECT_EQ(journal.size(), 3U * 12U);  // to learn from, and as they are tested
}

}  // namespace
}  // namespace spincat
