// Repeated stratified splits into training and test objects.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#pragma GCC visibility push(default)
namespace spincat {

// Indices into the data set's objects, ascending in each.
struct Split {
  std::vector<std::uint32_t> train;
  std::vector<std::uint32_t> test;
};

inline constexpr int kMostSplits = 10'000;

// Throws InputError unless 1 <= count <= kMostSplits and 0 < test_share < 1: what stratified_splits asks for, to be
// checked before hours of work.
void check_splits(int count, double test_share);

// `count` independent random splits. Of every category with n objects, round(n * test_share) go to the test part
// (ties to even), but at least 1 and at most n - 1; a category with one object is only ever trained on.
//
// `labels` holds the category of each object. Deterministic: the same labels, count, share and seed give the same
// splits on every machine, and split i does not depend on `count`.
//
// Throws InputError as check_splits does, and unless some category has two objects.
std::vector<Split> stratified_splits(std::span<const std::uint32_t> labels, int count, double test_share,
                                     std::uint64_t seed);

// Cuts the objects into `folds` stratified parts that together hold each object once as a test object (k-fold cross-
// validation); folds may be as many as there are objects (leave-one-out). The test parts differ by at most one object,
// in all and in each category. When a category's only object is tested, nothing of that category is trained on.
// Deterministic, as above.
//
// Throws InputError unless 2 <= folds <= labels.size().
std::vector<Split> stratified_folds(std::span<const std::uint32_t> labels, int folds, std::uint64_t seed);

}  // namespace spincat
#pragma GCC visibility pop
