// SPDX-License-Identifier: BSD-3-Clause
#include "Core/Flow/Particles/LatticeOrder.h"

#include <algorithm>

namespace RectifiedTransport
{

namespace
{

// Cells a side, by dimension, of a block of 64 particles and of a tile that fits the caches.
constexpr std::int64_t blockSides[] = { 64, 8, 4 };
constexpr std::int64_t tileSides[] = { 4096, 64, 16 };

// A part of a lattice is divided into cubes, those at the upper border smaller, and counted cube by
// cube, axis 0 fastest: narrows the part to the cube that holds cell `number`, which becomes a
// number in the cube.
template <int Dimension>
void narrow(LatticePart<Dimension>& part, std::int64_t side, std::int64_t& number)
{
  for (int axis = Dimension; axis-- > 0;)
  {
    const std::int64_t layer = part.Count() / part.Cells[axis];
    const std::int64_t cube = number / (side * layer);
    number -= cube * side * layer;
    part.Low[axis] += cube * side;
    part.Cells[axis] = std::min(side, part.Cells[axis] - cube * side);
  }
}

} // namespace

template <int Dimension>
void LatticeOrder<Dimension>::Fill(
  std::int64_t first, int count, std::int64_t* index, double* points) const
{
  std::int64_t before = 0; // samples of the parts before
  auto part = this->Chosen.Parts.begin();
  while (count > 0)
  {
    while (first - before >= part->Count())
    {
      before += part->Count();
      ++part;
    }
    std::int64_t number = first - before;
    LatticePart<Dimension> block = *part;
    narrow(block, tileSides[Dimension - 1], number);
    narrow(block, blockSides[Dimension - 1], number);
    const int taken = static_cast<int>(std::min<std::int64_t>(count, block.Count() - number));
    first += taken;
    count -= taken;

    GridSize<Dimension> cell = block.CellOf(number);
    for (int i = 0; i < taken; ++i)
    {
      *index++ = this->Chosen.IndexOf(cell);
      for (int axis = 0; axis < Dimension; ++axis)
      {
        *points++ =
          latticePoint(cell[axis], this->Place[axis], this->Lattice[axis], this->Size[axis]);
      }
      for (int axis = 0; axis < Dimension && ++cell[axis] == block.Low[axis] + block.Cells[axis];
           ++axis)
      {
        cell[axis] = block.Low[axis];
      }
    }
  }
}

RECTIFIEDTRANSPORT_INSTANTIATE_CLASS(LatticeOrder);

} // namespace RectifiedTransport
