// The panels of the picture, each drawn from results.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "sight.h"
#include "spincat/classify/classify.h"
#include "spincat/spin/params.h"
#include "svg.h"

inline constexpr std::string_view kInk = "#1f2733";
inline constexpr std::string_view kFaint = "#5d6878";

// The colours of the spin points and of the frames around their images; also told apart by their numbers.
std::string_view mark_colour(std::size_t number);

// Points as dots `size` pixels wide, the furthest first, hidden ones pale; `marked` as numbered discs.
void draw_points(Svg& svg, std::span<const SeenPoint> points, double size, std::span<const SeenPoint> marked);

// A spin image, its channels added up, as a heat map in a frame of `size` pixels; brightness grows with the square root
// of the value.
void draw_spin_image(Svg& svg, std::span<const float> image, const spincat::SpinImageShape& shape, double x, double y,
                     double size, std::size_t number);

// A row of boxes for each category, one filled for each judge that voted for it.
void draw_votes(Svg& svg, const spincat::Ballot& ballot, const std::vector<std::string>& categories, const Box& box);

// The winner's name and the confidence, with a gauge.
void draw_name(Svg& svg, const std::string& name, double confidence, const Box& box);
