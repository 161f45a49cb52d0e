#include "spincat/encode/block_sums.h"

#include <utility>

namespace spincat {
namespace {

void add_to(std::vector<double>& sums, const std::vector<double>& more) {
  for (std::size_t i = 0; i < sums.size(); ++i) {
    sums[i] += more[i];
  }
}

}  // namespace

void SumsTree::add(SumsNode node) {
  nodes_.push_back(std::move(node));
  while (nodes_.size() > 1 && nodes_[nodes_.size() - 2].level == nodes_.back().level) {
    SumsNode& left = nodes_[nodes_.size() - 2];
    add_to(left.sums, nodes_.back().sums);
    ++left.level;
    nodes_.pop_back();
  }
}

std::vector<double> SumsTree::total() const {
  std::vector<double> sums = nodes_.back().sums;
  for (std::size_t n = nodes_.size() - 1; n-- > 0;) {
    add_to(sums, nodes_[n].sums);
  }
  return sums;
}

void BlockSums::add(const SpinImageBlock& block) {
  if (leaf_.empty()) {
    leaf_.assign(object_.size(), 0.0);
  }
  object_.accumulate(block, leaf_);
  if ((block.first / kSpinImageBlock + 1) % kLeafBlocks == 0) {
    close_leaf();
  }
}

void BlockSums::close_leaf() {
  tree_.add({0, std::move(leaf_)});
  leaf_.clear();
}

SumsTree BlockSums::finish() {
  if (!leaf_.empty() || tree_.nodes().empty()) {
    leaf_.resize(object_.size(), 0.0);
    close_leaf();
  }
  return std::move(tree_);
}

}  // namespace spincat
