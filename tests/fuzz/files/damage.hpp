// Seeded damage to the bytes of a file, of the kinds that disks do.
#pragma once

#include <filesystem>
#include <random>
#include <string>

namespace roci::fuzz {

/// One to four of: bytes flipped, a run of bytes made zero or moved elsewhere, the end cut off, a number made absurd.
std::string damaged(std::string bytes, std::mt19937_64& random);

std::string read_bytes(const std::filesystem::path& file);
void write_bytes(const std::filesystem::path& file, const std::string& bytes);

}  // namespace roci::fuzz
