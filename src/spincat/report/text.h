// Results as plain text for people: what the command prints when no JSON is asked for.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "spincat/classify/model.h"
#include "spincat/evaluate/evaluate.h"
#include "spincat/judge/ballot.h"
#include "spincat/prepare/facts.h"

namespace spincat {

// "1.3 ms", "12.4 s", "3 min 20 s".
std::string human_seconds(double seconds);

// How far a stage of the work is, in one line of at most `width` columns: a bar where there is room for it, how much is
// done, the rate, and the time left at that rate. `seconds` were spent so far.
std::string progress_line(std::string_view stage, std::size_t done, std::size_t total, double seconds,
                          std::size_t width);

// The rates with their spread and intervals, the objects of each category, and the confusion matrix in per cent of each
// row, coloured where `colours` is true. Where it would be wider than `width` columns, long names are cut in the
// middle; where that is not enough, the rate of each category and the most confused pairs stand in its place.
std::string evaluation_text(const Evaluation& evaluation, std::size_t width, bool colours = false);

// Every judge's word on one object: "chair  not couch  0.84", those for the winner first, then by strength; and, where
// there was a tie, how it was broken.
std::string ballot_text(const Ballot& ballot, const std::vector<std::string>& categories);

// What a model holds, in lines of at most `width` columns (0: as long as they are).
std::string model_text(const Model& model, std::size_t width = 0);

// What an object's file holds, and what is wrong with it.
std::string object_text(const ObjectFacts& facts);

}  // namespace spincat
