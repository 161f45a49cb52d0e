// From how close a vote was to how likely its winner is right.
#pragma once

#include <span>

#include "spincat/judge/ballot.h"

namespace spincat {

// confidence = 1 / (1 + exp(-(slope * weakest_margin + familiarity_slope * familiarity + offset))), where
// weakest_margin is the winner's smallest margin over all its judges (Platt scaling of the whole vote instead of a
// single SVM), and familiarity (familiarity.h) tells how like the winner's training objects the object is.
struct Calibration {
  double slope = 2.0;  // of an uncalibrated model: one half at margin 0, 0.88 at margin 1
  double offset = 0.0;
  double familiarity_slope = 0.0;

  // In (0, 1).
  double confidence(const Ballot& ballot, double familiarity = 0.0) const;
};

// A vote on an object whose category is known, by judges that were not trained on it.
struct JudgedObject {
  double weakest_margin = 0.0;
  bool right = false;
  double familiarity = 0.0;
};

// Fits slopes and offset to such votes by maximum likelihood (Newton steps with Platt's softened targets, so that a
// handful of votes or votes that are all right do not give certainty). Deterministic. The uncalibrated values when
// there are fewer than ten votes.
//
// `unknown_objects` are votes on objects of a category that none of their judges knew (whatever they said was wrong).
// They decide how much familiarity counts beside the margin, and nothing else: slope and offset are then fitted to
// `votes` alone, so that the confidence is how often a name of a known object is right. Without unknown objects,
// familiarity does not count.
Calibration fit_calibration(std::span<const JudgedObject> votes, std::span<const JudgedObject> unknown_objects = {});

}  // namespace spincat
