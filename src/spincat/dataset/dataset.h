// What to learn from: objects on disk and the category of each.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace spincat {

// One object of a data set. It is not read here: `file` is where it should be.
struct DatasetObject {
  std::filesystem::path file;
  std::uint32_t category = 0;  // index into Dataset::categories
  std::string split;           // "train", "test", ... where the data set has an official split; else empty
};

// Something that the data set names and that cannot be used, with the reason.
struct SkippedObject {
  std::filesystem::path file;
  std::string reason;
};

struct Dataset {
  std::string name;                     // for titles: the argument as the user gave it
  std::vector<std::string> categories;  // sorted by name (byte order), each with at least one object
  std::vector<DatasetObject> objects;   // sorted by file, each file once
  std::vector<SkippedObject> skipped;   // listed but not there, and the like; in the order they were met
};

struct DatasetOptions {
  // Where the models are that a CSV or .cla names by relative paths or numbers. Empty: beside the CSV file; for a .cla
  // file it is found as ../db or ./db beside it where that exists (the layout of the Princeton Shape Benchmark).
  std::filesystem::path models;
  // A CSV file with the columns class,category: keeps only the classes it lists, under their new category names.
  // In a .cla file a class may also be listed by the name of any of its ancestors; the nearest listed one wins.
  std::filesystem::path category_map;
};

// Reads a data set from one or more sources of any of these kinds, merged into one:
//  - a folder with one sub-folder per category; objects may lie deeper. Sub-folders called train, test, val or
//    validation, either directly inside the data set or directly inside each category (ModelNet), give the split and are
//    no categories. Files that are no object files (textures, notes), and names that start with a dot, are passed over.
//  - a folder with classification/*.cla and db/ inside: the Princeton Shape Benchmark, all its .cla files merged
//  - a CSV file with a header line that names at least the columns path and category, and maybe split; lines that start
//    with # are comments; other columns are ignored; quoting by RFC 4180
//  - a classification file of the Princeton Shape Benchmark (.cla); the leaf classes are the categories; the split is
//    the file's own name without its extension, when that is train or test. Model N is N/100/mN/mN.off below `models`.
// The order does not depend on the file system's. Deterministic.
// Throws InputError when a source is missing or malformed (with its line), when no object is left, when only one
// category is left, or when two sources give one file different categories.
Dataset read_dataset(const std::vector<std::filesystem::path>& sources, const DatasetOptions& options = {});

}  // namespace spincat
