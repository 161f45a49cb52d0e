#include "spincat/evaluate/split_edges.h"

#include <algorithm>
#include <compare>
#include <cstdint>
#include <map>
#include <queue>
#include <utility>
#include <vector>

#include "spincat/prepare/normalise.h"
#include "spincat/prepare/repeats.h"

namespace spincat {
namespace {

using Ends = std::pair<std::uint32_t, std::uint32_t>;  // the smaller one first

struct Edge {
  double length;
  std::uint64_t number;  // in the order in which they were made
  Ends ends;

  // The top of a queue is the longest one, of equals the first one.
  bool operator<(const Edge& other) const {
    return length != other.length ? length < other.length : number > other.number;
  }
};

class EdgeSplitter {
 public:
  explicit EdgeSplitter(const Mesh& mesh) : mesh_{mesh.vertices, {}} {
    const std::vector<std::uint32_t> first = first_at_position(mesh.vertices);
    for (const Triangle& t : mesh.triangles) {
      add({first[t[0]], first[t[1]], first[t[2]]});
    }
  }

  std::size_t triangles() const { return mesh_.triangles.size(); }

  double longest_edge() {
    while (!waiting_.empty() && !triangles_at_.contains(waiting_.top().ends)) {
      waiting_.pop();
    }
    return waiting_.empty() ? 0.0 : waiting_.top().length;
  }

  // Precondition: there is an edge.
  void split_longest() {
    const auto [a, b] = waiting_.top().ends;
    const auto middle = static_cast<std::uint32_t>(mesh_.vertices.size());
    mesh_.vertices.emplace_back(0.5 * (mesh_.vertices[a] + mesh_.vertices[b]));
    const std::vector<std::uint32_t> around = triangles_at_[{a, b}];
    for (const std::uint32_t f : around) {
      const Triangle t = mesh_.triangles[f];
      Triangle half = t;
      std::ranges::replace(half, a, middle);
      Triangle other = t;
      std::ranges::replace(other, b, middle);
      forget(f);
      place(f, half);
      add(other);
    }
  }

  Mesh take() { return without_unused_vertices(mesh_); }

 private:
  static Ends ends_of(const Triangle& t, std::size_t k) { return std::minmax({t[k], t[(k + 1) % 3]}); }

  void add(const Triangle& t) {
    if (t[0] != t[1] && t[1] != t[2] && t[2] != t[0]) {
      mesh_.triangles.push_back(t);
      place(static_cast<std::uint32_t>(mesh_.triangles.size() - 1), t);
    }
  }

  void place(std::uint32_t f, const Triangle& t) {
    mesh_.triangles[f] = t;
    for (std::size_t k = 0; k < 3; ++k) {
      const Ends ends = ends_of(t, k);
      std::vector<std::uint32_t>& around = triangles_at_[ends];
      if (around.empty()) {
        waiting_.push({(mesh_.vertices[ends.first] - mesh_.vertices[ends.second]).norm(), made_++, ends});
      }
      around.push_back(f);
    }
  }

  void forget(std::uint32_t f) {
    for (std::size_t k = 0; k < 3; ++k) {
      const auto at = triangles_at_.find(ends_of(mesh_.triangles[f], k));
      std::erase(at->second, f);
      if (at->second.empty()) {
        triangles_at_.erase(at);
      }
    }
  }

  Mesh mesh_;
  std::map<Ends, std::vector<std::uint32_t>> triangles_at_;
  std::priority_queue<Edge> waiting_;  // those that are gone, too
  std::uint64_t made_ = 0;
};

}  // namespace

Mesh with_split_edges(const Mesh& mesh, std::size_t triangles, double length) {
  EdgeSplitter splitter(mesh);
  while (splitter.triangles() < triangles && splitter.longest_edge() > length) {
    splitter.split_longest();
  }
  return splitter.take();
}

}  // namespace spincat
