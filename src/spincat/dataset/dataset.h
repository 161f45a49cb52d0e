// What to learn from: objects on disk and the category of each.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "spincat/io/read_limits.h"

#pragma GCC visibility push(default)
namespace spincat {

// One object of a data set. It is not read here: `file` is where it should be.
struct DatasetObject {
  std::filesystem::path file;
  std::uint32_t category = 0;  // index into Dataset::categories
  std::string split;           // "train", "test", ... where the data set has an official split; else empty
};

// Something that the data set names and that cannot be used, with the reason: a listed file that is not there, an
// object outside every category's folder, a category's folder without objects, a class of the map that no source knows.
struct SkippedObject {
  std::filesystem::path file;
  std::string reason;
};

struct Dataset {
  std::string name;                                // for titles: the argument as the user gave it
  std::vector<std::string> categories;             // sorted by name (byte order), each with at least one object
  std::vector<DatasetObject> objects;              // sorted by file, each file once
  std::vector<SkippedObject> skipped;              // in the order they were met
  std::vector<std::filesystem::path> others = {};  // objects of none of the categories, by which strangers are known
  ReadLimits limits = {};                          // while reading its objects
};

// A category that takes no part in an evaluation, and why.
struct LeftOutCategory {
  std::string name;
  std::string reason;  // as "has 3 objects"
};

struct DatasetOptions {
  // Where the models are that a CSV or .cla names by relative paths or numbers. Empty: beside the CSV file; for a .cla
  // file it is found as ../db or ./db beside it where that exists (the layout of the Princeton Shape Benchmark).
  std::filesystem::path models;
  // A CSV file with the columns class,category: keeps only the classes it lists, under their new category names.
  // In a .cla file a class may also be listed by the name of any of its ancestors; the nearest listed one wins.
  std::filesystem::path category_map;
  // Objects of none of the categories, as read_objects takes them: what is like them is a stranger. Empty: none.
  std::filesystem::path others = {};
  std::filesystem::path others_models = {};
  // While reading the lists, and later the objects.
  ReadLimits limits = {};
};

// Reads a data set from one or more sources of any of these kinds, merged into one:
//  - a folder with one sub-folder per category; objects may lie deeper. Sub-folders called train, test, val or
//    validation, either directly inside the data set or directly inside each category (ModelNet), give the split and
//    are no categories. Files that are no object files (textures, notes), and names that start with a dot, are passed
//    over. Symbolic links are followed, each folder once a category.
//  - a folder with classification/*.cla and db/ inside: the Princeton Shape Benchmark, all its .cla files merged
//  - a CSV file with a header line that names at least the columns path and category, and maybe split (train, test,
//  val, validation or nothing); lines that start
//    with # are comments; other columns are ignored; quoting by RFC 4180
//  - a classification file of the Princeton Shape Benchmark (.cla); the classes that list models themselves are the
//    categories; the split is the file's own name without its extension, when that is train or test. Model N is
//    N/100/mN/mN.off below `models`.
//
// A file is known again under another name (a link, a/../b) and kept under the name that sorts first. The order does
// not depend on the file system's nor on that of the sources. Deterministic.
//
// Throws InputError when a source is missing, cannot be read or is malformed (with its line), when no object is left,
// when only one category is left, or when one file is given two categories or two splits.
Dataset read_dataset(const std::vector<std::filesystem::path>& sources, const DatasetOptions& options = {});

// The part of a data set with an official split that judges may learn from: the objects of the split "train" and those
// without one, and the categories that have such objects. The whole data set when nothing is marked "train".
Dataset training_part(const Dataset& dataset);

// The part of a data set that its own split marks "test"; training_part is the other. Throws InputError
// when nothing is marked "test", or all is.
Dataset testing_part(const Dataset& dataset);

}  // namespace spincat
#pragma GCC visibility pop
