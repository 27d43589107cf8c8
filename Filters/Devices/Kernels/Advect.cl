// SPDX-License-Identifier: BSD-3-Clause
// Advections of particles on a device: indexing alone; the shared kernels have the arithmetic.

#define RT_TABLES                                                                                  \
  __constant FlowInput *input, __global const double *fine, __global const double *coarse,         \
    __global const ulong *occupied
#define RT_MAP                                                                                     \
  long mapSteps, long levelCount, __constant MapLevelInput *levels, __global const float *records, \
    __global const uchar *bad

// Structures of pointers cannot be arguments of kernels: they are made here.
TableInput tablesOf(RT_TABLES)
{
  TableInput tables;
  tables.Input = input;
  tables.Fine = fine;
  tables.Coarse = coarse;
  tables.Occupied = occupied;
  return tables;
}

MapInput mapOf(RT_MAP)
{
  MapInput map;
  map.Steps = mapSteps;
  map.LevelCount = levelCount;
  map.Levels = levels;
  map.Records = records;
  map.Bad = bad;
  return map;
}

// Points are interleaved.
void readPoint(__global const double* points, size_t i, double* x)
{
  for (int axis = 0; axis < RT_D; ++axis)
  {
    x[axis] = points[i * RT_D + axis];
  }
}

void writePoint(__global double* points, size_t i, const double* x)
{
  for (int axis = 0; axis < RT_D; ++axis)
  {
    points[i * RT_D + axis] = x[axis];
  }
}

// `count` points of a lattice from the number `first` on, as LatticeOrder.h places them.
__kernel __attribute__((reqd_work_group_size(64, 1, 1))) void placeLattice(
  LatticeInput lattice, long first, uint count, __global double* points)
{
  if (get_global_id(0) >= count)
  {
    return;
  }
  long rest = first + get_global_id(0);
  double x[RT_D];
  for (int axis = 0; axis < RT_D; ++axis)
  {
    const long cells = lattice.Cells[axis];
    const double cell = (double)(axis < RT_D - 1 ? rest % cells : rest);
    rest /= cells;
    x[axis] = (cell + lattice.Place[axis]) * lattice.Size[axis] / (double)cells;
  }
  writePoint(points, get_global_id(0), x);
}

// What is known of a particle after its passes: velocity evaluations, twice, and whether it is
// unresolved.
uint statusOf(const ParticleState* s)
{
  return 2 * (uint)s->Evaluations + (s->IsUnresolved ? 1 : 0);
}

// Forward, passes [pass, lastPass] (AdvectBlock in FlowKernels.h) of `count` particles, those of a
// list if there is one, until they are resolved. A pass from seeds may be cut in pieces, of the
// steps [first, last), between which the states are kept. A particle may be given up in any pass
// but the very last one.
__kernel __attribute__((reqd_work_group_size(64, 1, 1))) void advectForward(RT_TABLES, RT_MAP,
  __global const StepWeights* mapWeights, __global const StepWeights* weights, long steps,
  long first, long last, int pass, int lastPass, int mayGiveUp, __global const double* seeds,
  int isListed, __global const uint* list, uint count, __global ParticleState* states,
  __global double* positions, __global uint* status)
{
  const uint i = get_global_id(0);
  if (i >= count)
  {
    return;
  }
  const TableInput tables = tablesOf(input, fine, coarse, occupied);
  const MapInput map = mapOf(mapSteps, levelCount, levels, records, bad);
  // The particle's number in the seeds and positions; states and status have one entry for each
  // item.
  const size_t particle = isListed ? list[i] : i;
  double seed[RT_D];
  readPoint(seeds, particle, seed);
  ParticleState s;
  s.Evaluations = 0;
  if (first > 0)
  {
    s = states[i];
  }
  // Passes from levels of the map, the finest first, until one has a good cell; then from the seed.
  int isLeft = 1;
  for (; pass <= lastPass && isLeft; ++pass)
  {
    const int fromMap = pass < 0;
    const long all = fromMap ? mapSteps : steps;
    __global const StepWeights* w = fromMap ? mapWeights : weights;
    long begin = first;
    if (first == 0)
    {
      placeParticle(&tables, seed, &s);
      // In a bad cell of this level nothing is read, and the next pass tries a wider one.
      s.IsUnresolved = fromMap && !advanceToHandOver(&tables, &map, -1 - pass, &s);
      if (s.IsUnresolved)
      {
        continue;
      }
      begin = fromMap ? all - levels[-1 - pass].HandOver : 0;
      if (!fromMap)
      {
        advanceStraightStart(&tables, &s);
      }
    }
    stepForward(&tables, w, all, begin, fromMap ? all : last, mayGiveUp, &s);
    // A piece of the steps ends here; the next run of the kernel goes on from the state.
    if (!fromMap && last < all)
    {
      states[i] = s;
      return;
    }
    finishForward(&tables, w + (all - 1), &s);
    isLeft = s.IsUnresolved;
  }
  writePoint(positions, particle, s.End);
  status[i] = statusOf(&s);
}

// Backward, the steps [first, last) of `steps`, those of the map if there is one.
__kernel __attribute__((reqd_work_group_size(64, 1, 1))) void advectBackward(RT_TABLES, RT_MAP,
  __global const StepWeights* weights, long steps, long first, long last,
  __global const double* points, uint count, __global ParticleState* states,
  __global double* positions, __global uint* status)
{
  const uint i = get_global_id(0);
  if (i >= count)
  {
    return;
  }
  const TableInput tables = tablesOf(input, fine, coarse, occupied);
  const MapInput map = mapOf(mapSteps, levelCount, levels, records, bad);
  ParticleState s;
  if (first > 0)
  {
    s = states[i];
  }
  else
  {
    double point[RT_D];
    readPoint(points, i, point);
    s.Evaluations = 0;
    // At time 1 the velocity is x - S/2, and the seed is found on the way back.
    placeParticle(&tables, point, &s);
    startBackward(&tables, &s);
  }
  stepBackward(&tables, &map, weights, steps, first, last, &s);
  if (last < steps)
  {
    states[i] = s;
    return;
  }
  writePoint(positions, i, s.End);
  status[i] = statusOf(&s);
}

// The unresolved of a list in its order: the numbers in each group, their sums, and the new list.

__kernel __attribute__((reqd_work_group_size(RT_GROUP, 1, 1))) void countUnresolved(
  __global const uint* status, uint count, __global PassCounts* counts)
{
  __local ulong evaluations[RT_GROUP];
  __local ulong unresolved[RT_GROUP];
  const uint at = get_local_id(0);
  const uint i = get_global_id(0);
  // Items beyond the count add nothing.
  const uint own = i < count ? status[i] : 0;
  evaluations[at] = own >> 1;
  unresolved[at] = own & 1;
  // A tree of additions in local memory.
  for (uint width = RT_GROUP / 2; width > 0; width /= 2)
  {
    barrier(CLK_LOCAL_MEM_FENCE);
    if (at < width)
    {
      evaluations[at] += evaluations[at + width];
      unresolved[at] += unresolved[at + width];
    }
  }
  if (at == 0)
  {
    counts[get_group_id(0)].Evaluations = evaluations[0];
    counts[get_group_id(0)].Unresolved = unresolved[0];
  }
}

// Replaces the number of each group by the sum of those before it; the sums of all go to `total`.
// One group of items.
__kernel __attribute__((reqd_work_group_size(RT_GROUP, 1, 1))) void sumCounts(
  __global PassCounts* counts, uint groups, __global PassCounts* total)
{
  __local ulong evaluations[RT_GROUP];
  __local ulong unresolved[RT_GROUP];
  const uint at = get_local_id(0);
  // Each item scans a share of the groups, from the sum of the shares before it.
  const uint share = (groups + RT_GROUP - 1) / RT_GROUP;
  const uint begin = min(at * share, groups);
  const uint end = min(begin + share, groups);
  ulong evaluated = 0;
  ulong found = 0;
  for (uint group = begin; group < end; ++group)
  {
    evaluated += counts[group].Evaluations;
    found += counts[group].Unresolved;
  }
  evaluations[at] = evaluated;
  unresolved[at] = found;
  barrier(CLK_LOCAL_MEM_FENCE);
  ulong before = 0;
  for (uint k = 0; k < at; ++k)
  {
    before += unresolved[k];
  }
  for (uint group = begin; group < end; ++group)
  {
    const ulong own = counts[group].Unresolved;
    counts[group].Unresolved = before;
    before += own;
  }
  if (at == RT_GROUP - 1)
  {
    ulong all = 0;
    for (uint k = 0; k < RT_GROUP; ++k)
    {
      all += evaluations[k];
    }
    total->Evaluations = all;
    total->Unresolved = before;
  }
}

__kernel __attribute__((reqd_work_group_size(RT_GROUP, 1, 1))) void keepUnresolved(
  __global const uint* status, uint count, __global const PassCounts* counts, int isListed,
  __global const uint* list, __global uint* kept)
{
  __local uint unresolved[RT_GROUP];
  const uint at = get_local_id(0);
  const uint i = get_global_id(0);
  const uint own = i < count ? status[i] & 1 : 0;
  unresolved[at] = own;
  barrier(CLK_LOCAL_MEM_FENCE);
  if (own)
  {
    // The place of an unresolved particle: those of the groups before, and those before it in its
    // group. The order of the list is kept.
    uint place = (uint)counts[get_group_id(0)].Unresolved;
    for (uint k = 0; k < at; ++k)
    {
      place += unresolved[k];
    }
    kept[place] = isListed ? list[i] : i;
  }
}

// For the self-test: what the host takes the kernels' state of a particle for.
__kernel void sizeOfState(__global ulong* size)
{
  size[get_global_id(0)] = sizeof(ParticleState);
}
