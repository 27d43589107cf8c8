// SPDX-License-Identifier: BSD-3-Clause
// Pictures as ink: 0 where they are white, 1 where they are black.
#ifndef ReadInk_h
#define ReadInk_h

#include <string>
#include <vector>

struct Ink
{
  int Width = 0;
  int Height = 0;
  std::vector<float> Values; // width x height, x fastest, y upwards
};

// Reads any picture that VTK has a reader for, resized so that its longer side has `side` cells.
// Returns false, with one sentence in `error`, for files that hold none.
bool readInk(const std::string& path, int side, Ink& ink, std::string& error);

#endif
