// The sums of an object's spin images, the same however its spin points are shared out.
//
// Runs of kLeafBlocks blocks are leaves; each leaf's images are added up in their order. Leaves are added in pairs, the
// pairs in pairs, and so on: a tree whose shape depends on the number of spin points alone. Whoever makes the images of
// a whole subtree can hand on its one row of sums. (Rounding errors grow with the tree's height only.)
#pragma once

#include <cstddef>
#include <vector>

#include "spincat/encode/encoding.h"
#include "spincat/spin/spin_images.h"

namespace spincat {

inline constexpr std::size_t kLeafBlocks = 8;
inline constexpr std::size_t kLeafPoints = kLeafBlocks * kSpinImageBlock;  // spin points of a leaf

// The sums of a whole subtree: 2^level leaves, fewer only at the end of the object.
struct SumsNode {
  std::size_t level = 0;
  std::vector<double> sums;
};

// Subtrees that lie side by side, from the left.
class SumsTree {
 public:
  // The next subtree; joined with those before it as far as they make a larger one.
  void add(SumsNode node);

  const std::vector<SumsNode>& nodes() const { return nodes_; }

  // All of them together. Precondition: there is one.
  std::vector<double> total() const;

 private:
  std::vector<SumsNode> nodes_;  // levels fall
};

// Adds up blocks.
class BlockSums {
 public:
  // `object` must outlive this.
  explicit BlockSums(const Encoding::ObjectSums& object) : object_(object) {}

  // The next block. The first one begins a leaf.
  void add(const SpinImageBlock& block);

  // All blocks so far; nothing may be added any more.
  SumsTree finish();

 private:
  void close_leaf();

  const Encoding::ObjectSums& object_;
  std::vector<double> leaf_;  // empty between two leaves
  SumsTree tree_;
};

}  // namespace spincat
