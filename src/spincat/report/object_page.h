// Pages with objects in 3D: what objects were named and why, and what an object's file holds.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "spincat/classify/classify.h"
#include "spincat/classify/evidence.h"
#include "spincat/classify/model.h"
#include "spincat/describe/describe.h"
#include "spincat/geometry/object.h"
#include "spincat/prepare/facts.h"
#include "spincat/settings/settings.h"

namespace spincat {

// How much of each object a page shows: less where there are many, so that a page of 600 objects stays below 25 MB.
struct PageDetail {
  std::size_t shape_bytes = 0;  // about, of an object's triangles or points
  std::size_t image_rows = 0;   // of a spin image, at most; bins are added up
};
PageDetail page_detail(std::size_t objects);

// What a page keeps of one object, as JSON: large objects are simplified.
struct PageObject {
  std::string result;   // classification_json without judges, or error_json
  std::string details;  // every judge's margin, its shape, its spin points and what they say, the spin images of the
                        // strongest; empty for an error
};

// Deterministic but for the measured time.
PageObject page_object(const std::string& file, const Classification& classification, const Model& model,
                       const Object& object, const Evidence& evidence, const PageDetail& detail, bool rejected = false);
PageObject page_object_error(const std::string& file, const std::string& error);

// Each object in 3D with what its spin points say, its votes and every judge's margin. `model_file` and `command`: as
// the user gave them.
std::string classification_page(const std::string& model_file, const Model& model,
                                const std::vector<PageObject>& objects, const std::vector<std::string>& command);

// The object with its surface points, their normals and its spin points, its facts, and which of its triangles are
// broken. The points are those that the first part of describe uses with these settings. Deterministic.
std::string object_page(const std::string& file, const Object& object, const ObjectFacts& facts,
                        const Preparation& preparation, const Settings& settings,
                        const std::vector<std::string>& command);

}  // namespace spincat
