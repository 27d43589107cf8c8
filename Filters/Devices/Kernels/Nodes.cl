// SPDX-License-Identifier: BSD-3-Clause
// The nodes of a lattice of a flow map on a device: indexing alone, after Advect.cl.

// Makes the records of the nodes [first, first + count) of a lattice with `nodes` nodes an axis, at
// `places`, those of axis 0 first. Each starts from the finest of `levelCount` levels that may be
// interpolated there. Forward from scratch to the three common times `time0` to `time2`.
__kernel __attribute__((reqd_work_group_size(64, 1, 1))) void advanceNodes(RT_TABLES, RT_MAP,
  __global const StepWeights* ofParticles, __global const StepWeights* weights,
  __constant NodeSteps* steps, long handOver, double time0, double time1, double time2,
  __global const double* places, long nodes0, long nodes1, long first, uint count,
  __global float* result, __global uchar* marks, __global uint* status)
{
  const uint i = get_global_id(0);
  if (i >= count)
  {
    return;
  }
  const TableInput tables = tablesOf(input, fine, coarse, occupied);
  const MapInput map = mapOf(mapSteps, levelCount, levels, records, bad);
  const long node = first + i;
  double place[RT_D];
  place[0] = places[node % nodes0];
#if RT_D == 3
  place[1] = places[nodes0 + node / nodes0 % nodes1];
  place[2] = places[nodes0 + nodes1 + node / (nodes0 * nodes1)];
#else
  place[1] = places[nodes0 + node / nodes0];
#endif
  ParticleState s;
  s.Evaluations = 0;
  int isMade = 0;
  for (int parent = (int)levelCount - 1; parent >= -1 && !isMade; --parent)
  {
    const NodeSteps own = steps[parent + 1];
    placeParticle(&tables, place, &s);
    if (input->Backward)
    {
      isMade = advanceNodeBackward(
        &tables, &map, weights + own.First, own.Steps, parent, own.Begin, own.End, &s);
    }
    else if (parent >= 0)
    {
      isMade = continueNode(&tables, &map, ofParticles, parent, handOver, &s);
    }
    else
    {
      startNode(&tables, weights + own.First, own.Steps, time0, time1, time2, &s);
      isMade = 1;
    }
  }
  marks[i] = s.IsUnresolved ? 1 : 0;
  status[i] = 2 * (uint)s.Evaluations;
  const size_t record = input->Backward ? RT_BACKWARD_RECORD : RT_FORWARD_RECORD;
  writeRecord(input->Backward, &s, result + i * record);
}
