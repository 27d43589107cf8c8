// SPDX-License-Identifier: BSD-3-Clause
#include "Core/SiteCells/EqualMasses/MergeComponents.h"

#include "Core/Parallel/LargeBuffer.h"
#include "Core/Parallel/Progress.h"

#include <algorithm>
#include <cstddef>
#include <utility>
#include <vector>

namespace RectifiedTransport
{

namespace
{

// Connected components of the pixels of each group, by union-find.
template <int Dimension>
class CellParts
{
public:
  CellParts(const PixelMasses<Dimension>& masses, std::int64_t* owners, Progress& progress)
    : Pixels(masses.NumberOfPixels())
    , Size(masses.Size())
    , Owners(owners)
    , Work(progress)
    , Part(masses.NumberOfPixels())
  {
    // First all pixels are connected to their predecessors, then every root gets the number of a
    // part.
    this->VisitPixels([this](std::int64_t pixel) { this->Connect(pixel); });
    // The first pixel of a part is its root, since Connect() joins to the smaller one: the pass in
    // order meets it first.
    this->VisitPixels([&](std::int64_t pixel) {
      std::int64_t& part = this->PartOf(pixel);
      if (part == pixel)
      {
        part = static_cast<std::int64_t>(this->Parts.size());
        this->Parts.push_back({ owners[pixel], 0, false });
      }
      else
      {
        part = this->PartOf(part);
      }
      this->Parts[static_cast<std::size_t>(part)].Mass += masses[pixel];
    });
  }

  // Marks as specks the parts with at most this mass that are not the heaviest part of their group.
  // Returns whether there are any.
  bool FindSpecks(std::int64_t groups, std::int64_t mostMass)
  {
    // The heaviest part of each group is the group's main part; of equal ones, the first.
    std::vector<const PartOfGroup*> heaviest(static_cast<std::size_t>(groups), nullptr);
    for (const PartOfGroup& part : this->Parts)
    {
      const PartOfGroup*& best = heaviest[static_cast<std::size_t>(part.Owner)];
      best = best && best->Mass >= part.Mass ? best : &part;
    }
    bool isAny = false;
    for (PartOfGroup& part : this->Parts)
    {
      part.IsSpeck =
        part.Mass <= mostMass && heaviest[static_cast<std::size_t>(part.Owner)] != &part;
      isAny = isAny || part.IsSpeck;
    }
    return isAny;
  }

  // Gives specks to groups beside them, not to other specks. Returns how many.
  std::int64_t Join()
  {
    using Face = std::pair<std::int64_t, std::int64_t>; // a speck, and the group beside it
    // One entry for each face between a speck and a main or large part, by the group of the latter.
    std::vector<Face> faces;
    const auto add = [&](std::int64_t speck, std::int64_t other) {
      const PartOfGroup& beside = this->Parts[static_cast<std::size_t>(other)];
      if (this->Parts[static_cast<std::size_t>(speck)].IsSpeck && !beside.IsSpeck)
      {
        faces.emplace_back(speck, beside.Owner);
      }
    };
    this->VisitPixels([&](std::int64_t pixel) {
      this->VisitPixelsBefore(pixel, [&](std::int64_t before) {
        if (this->PartOf(pixel) != this->PartOf(before))
        {
          add(this->PartOf(pixel), this->PartOf(before));
          add(this->PartOf(before), this->PartOf(pixel));
        }
      });
    });
    std::sort(faces.begin(), faces.end());
    // A speck joins the group with most of its faces, the one with the lowest number if several
    // have as many.
    std::int64_t joined = 0;
    for (auto face = faces.begin(); face != faces.end(); ++joined)
    {
      const std::int64_t speck = face->first;
      // Equal faces are consecutive: the longest run is the group with most faces in common.
      for (std::ptrdiff_t most = 0; face != faces.end() && face->first == speck;)
      {
        const auto end = std::upper_bound(face, faces.end(), *face);
        if (end - face > most)
        {
          most = end - face;
          this->Parts[static_cast<std::size_t>(speck)].Owner = face->second;
        }
        face = end;
      }
    }
    this->VisitPixels([this](std::int64_t pixel) {
      this->Owners[pixel] = this->Parts[static_cast<std::size_t>(this->PartOf(pixel))].Owner;
    });
    return joined;
  }

private:
  // A connected part: its group, its mass, and whether it is a speck.
  struct PartOfGroup
  {
    std::int64_t Owner;
    std::int64_t Mass;
    bool IsSpeck;
  };

  template <class Visit>
  // Visits are on this thread, in order: union-find needs the pixels before a pixel.
  void VisitPixels(const Visit& visit)
  {
    constexpr std::int64_t grain = std::int64_t{ 1 } << 16;
    this->Work.ForEachInOrder(this->Pixels, grain, visit);
  }

  // Calls visit(before) for the pixel before this one along each axis.
  template <class Visit>
  void VisitPixelsBefore(std::int64_t pixel, const Visit& visit) const
  {
    std::int64_t rest = pixel;
    std::int64_t stride = 1;
    for (int axis = 0; axis < Dimension; ++axis)
    {
      if (rest % this->Size[axis] > 0)
      {
        visit(pixel - stride);
      }
      rest /= this->Size[axis];
      stride *= this->Size[axis];
    }
  }

  std::int64_t& PartOf(std::int64_t pixel) { return this->Part.data()[pixel]; }

  // Returns the root of a pixel's tree. Path halving keeps the trees flat.
  std::int64_t RootOf(std::int64_t pixel)
  {
    while (this->PartOf(pixel) != pixel)
    {
      this->PartOf(pixel) = this->PartOf(this->PartOf(pixel));
      pixel = this->PartOf(pixel);
    }
    return pixel;
  }

  // Joins the tree of a pixel to those of the pixels before it in the same group.
  void Connect(std::int64_t pixel)
  {
    this->PartOf(pixel) = pixel;
    this->VisitPixelsBefore(pixel, [&](std::int64_t before) {
      if (this->Owners[before] == this->Owners[pixel])
      {
        const auto [first, second] = std::minmax({ this->RootOf(before), this->RootOf(pixel) });
        this->PartOf(second) = first;
      }
    });
  }

  const std::int64_t Pixels;
  const GridSize<Dimension> Size;
  std::int64_t* Owners;
  Progress& Work;
  LargeBuffer<std::int64_t> Part; // part of each pixel
  std::vector<PartOfGroup> Parts;
};

} // namespace

template <int Dimension>
std::int64_t mergeComponents(const SiteGroups& groups, const PixelMasses<Dimension>& masses,
  std::int64_t* owners, Progress& progress)
{
  // A part with more than a tenth of a site's mass stays where it is.
  // Smaller ones are isolated pixels of the flow's labels, or what moved borders have cut off.
  constexpr std::int64_t tenth = 10;
  CellParts<Dimension> parts(masses, owners, progress);
  return parts.FindSpecks(groups.NumberOfGroups(), masses.Total() / tenth / groups.NumberOfSites())
    ? parts.Join()
    : 0;
}

template decltype(mergeComponents<2>) mergeComponents<2>;
template decltype(mergeComponents<3>) mergeComponents<3>;

} // namespace RectifiedTransport
