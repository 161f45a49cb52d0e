// Results as plain text for people: what the command prints when no JSON is asked for.
#pragma once

#include <string>
#include <vector>

#include "spincat/judge/ballot.h"
#include "spincat/pipeline/evaluate.h"
#include "spincat/pipeline/model.h"
#include "spincat/prepare/facts.h"

namespace spincat {

// "1.3 ms", "12.4 s", "3 min 20 s".
std::string human_seconds(double seconds);

// The rates with their spread and intervals, the objects of each category, and the confusion matrix in per cent of each
// row; where the matrix would be wider than `width` columns, the rate of each category and the most confused pairs
// instead.
std::string evaluation_text(const Evaluation& evaluation, std::size_t width);

// Every judge's word on one object: "chair  not couch  0.84", those for the winner first, then by strength; and, where
// there was a tie, how it was broken.
std::string ballot_text(const Ballot& ballot, const std::vector<std::string>& categories);

// What a model holds.
std::string model_text(const Model& model);

// What an object's file holds, and what is wrong with it.
std::string object_text(const ObjectFacts& facts);

}  // namespace spincat
