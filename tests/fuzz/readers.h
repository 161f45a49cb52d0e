// Every reader of files, by its name: for the fuzz program and for the tests that feed them what it found.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace spincat::test {

// off, obj, ply, stl, pcd, xyz, gltf, threemf, numpy, las, kitti, csv, cla, model, journal, sweep, settings, png,
// frames (TUM's depth.txt), camera (camera.txt)
const std::vector<std::string>& reader_names();

// Hands the bytes to a reader; what it said where it refused them, nothing where it read them. Some are read twice:
// model and journal also as the content of a file whose checksum is right, as nothing that changes bytes at random
// would ever get past it; threemf and numpy also as the content of a good archive; pcd also as a picture, png also as
// the pixels of one, csv also as a map of classes, cla also with such a map. journal and sweep are added to and read
// once more; a gltf file may name a.bin, b.bin (the same), none.bin (empty) and folder.bin. Throws std::logic_error
// when the reader breaks a promise, be it that an object is none, and whatever it throws but InputError.
std::vector<std::string> read_as(std::string_view reader, std::string_view bytes);

}  // namespace spincat::test
