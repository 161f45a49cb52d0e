// One object whose spin points are shared out.
#include "spincat/describe/dense_object.h"

#include <gtest/gtest.h>

#include "spincat/describe/describe.h"
#include "spincat/parallel/journal.h"
#include "support/temp_dir.h"
#include "support/tiny_dataset.h"

namespace spincat {
namespace {

class DenseObjects : public testing::Test {
 protected:
  DenseObjects() : prepared_(prepare_object(test::box(1, 2, 3), settings())) {}

  static Settings settings() {
    Settings settings = test::tiny_settings();
    settings.prepare.points = 2'000;
    settings.prepare.spin_points = 1'500;
    return settings;
  }

  DenseObject object() const { return {prepared_.object.surface, prepared_.object.spin_points, prepared_.params}; }

  test::TempDir dir_;
  Preparation prepared_;
};

// A data set's images are gigabytes.
TEST_F(DenseObjects, AJournalKeepsSumsAndWantedImagesAlone) {
  Journal journal(dir_.path() / "j", {"settings", "data"});
  LocalFarm own(1);
  own.farm().use_journal(&journal);
  const std::string encoding = settings().encoding;
  const FeatureVector of_images = encode_object(own.farm(), object(), encoding, WorkSplit::return_images, {});
  EXPECT_EQ(journal.size(), 0U);
  const FeatureVector of_sums = encode_object(own.farm(), object(), encoding, WorkSplit::encode_remotely, {});
  EXPECT_EQ(journal.size(), 3U);
  EXPECT_EQ(of_images.values, of_sums.values);
  make_spin_images(own.farm(), object(), [](std::size_t, std::span<const float>) {}, {});
  EXPECT_EQ(journal.size(), 6U);
}

}  // namespace
}  // namespace spincat
