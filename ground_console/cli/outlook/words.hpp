// This file has words and numbers that the views of an outlook share.
#pragma once

#include <cstdint>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "ground_console/cli/outlook/svg.hpp"
#include "roci_idl/outlook.h"

namespace roci::console::cli::outlook {

// Colours that remain apart for most colour-blind eyes, on white and in grey.
inline constexpr char kText[] = "#1d2733";
inline constexpr char kFaint[] = "#6b7785";
inline constexpr char kRule[] = "#d9dee4";
inline constexpr char kPale[] = "#eef1f4";
inline constexpr char kBlue[] = "#2f6db5";
inline constexpr char kPaleBlue[] = "#a9c8ea";
inline constexpr char kGreen[] = "#2a8a57";
inline constexpr char kRed[] = "#c0392b";
inline constexpr char kOrange[] = "#e08a1e";

const char* name_of(v1::DataTier tier);
const char* name_of(v1::ProductFate fate);
const char* name_of(v1::ChainStage stage);
const char* name_of(v1::SignatureOutcome outcome);
const char* colour_of(v1::DataTier tier);

/// "2,500 B", "2.5 kB", "3 MB": three digits from a kilobyte on.
std::string bytes_text(std::uint64_t bytes);
/// "40 J", "4 kJ", "1.25 MJ".
std::string joules_text(double joules);
/// "95 s", "5 min", "2.5 h".
std::string duration_text(double seconds);
double seconds(std::int64_t us);

/// "3 of lander, made at 00:12:00 with plan 4 (network small-lander, version 1)"; `Sample` is a schedule or an outlook.
template <class Sample>
std::string made_text(const Sample& sample);
/// Begins an object with robot, version, time_s, plan_version, network, network_version and omitted.
template <class Sample>
nlohmann::json made_json(const Sample& sample);

/// Title and subtitle at the top of a picture.
void draw_title(Svg& svg, const std::string& title, const std::string& subtitle);
/// The height that they take.
inline constexpr double kTop = 64;

/// Marks of a scale from 0 or above to `most`: 1, 2 or 5 times a power of ten apart, `count` of them at most.
std::vector<double> marks(double least, double most, int count);
/// Marks of a time scale in seconds: whole minutes, hours or days apart.
std::vector<double> time_marks(double from_s, double to_s, int count);

}  // namespace roci::console::cli::outlook
