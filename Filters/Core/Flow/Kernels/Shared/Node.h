// SPDX-License-Identifier: BSD-3-Clause
// One node of a flow map's lattice (FlowMapNodes.txx). Forward, its seed is taken to its level's
// hand-over; backward, the particle that is there then is taken to its seed.
#ifndef RectifiedTransport_Node_h
#define RectifiedTransport_Node_h

// From its seed: `graded` leads in `steps` steps from the end of the straight start to the first of
// three common times, two steps with weights of the node's own to the others. IsUnresolved tells
// whether a box was empty.
RT_FUNCTION void startNode(const TableInput* tables, RT_GLOBAL const StepWeights* graded,
  Int64 steps, double time0, double time1, double time2, ParticleState* s)
{
  ParticleBox box;
  advanceStraightStart(tables, s);
  const double span = time0 - s->Start;
  for (Int64 step = 0; step < steps; ++step)
  {
    takeGradedStep(tables, graded + step, span, s->Start + span * graded[step].Time, s, &box);
    s->IsUnresolved |= box.IsVoid > 0.0;
  }
  // Times since the last but one velocity and the one before it.
  double first = graded[steps - 1].Length * span;
  double second = first + graded[steps - 2].Length * span;
  for (int common = 0; common < 2; ++common)
  {
    const double time = common == 0 ? time1 : time2;
    const double length = time - (common == 0 ? time0 : time1);
    double p[3];
    double c[3];
    adamsWeights(-first / length, -second / length, p, c);
    second = first + length;
    first = length;
    takeStep(tables, p, c, 1.0, length, time, s, &box);
    s->IsUnresolved |= box.IsVoid > 0.0;
  }
}

// From the hand-over of a coarser level, which gives where the node is then, to that of its own.
// Returns whether the coarser level may be read: else nothing is done.
RT_FUNCTION int continueNode(const TableInput* tables, const MapInput* map,
  RT_GLOBAL const StepWeights* weights, int parent, Int64 handOver, ParticleState* s)
{
  if (!advanceToHandOver(tables, map, parent, s))
  {
    return 0;
  }
  const double span = 1.0 - RT_COMMON_START;
  const Int64 end = map->Steps - handOver;
  for (Int64 step = map->Steps - map->Levels[parent].HandOver; step < end; ++step)
  {
    ParticleBox box;
    takeGradedStep(
      tables, weights + step, span, RT_COMMON_START + span * weights[step].Time, s, &box);
    s->IsUnresolved |= box.IsVoid > 0.0;
  }
  return 1;
}

// Backwards in graded steps from the time `begin` of its level to `end`, that of a coarser one or
// 0. End is the seed, if IsDone. Returns that: else a still coarser level must serve.
RT_FUNCTION int advanceNodeBackward(const TableInput* tables, const MapInput* map,
  RT_GLOBAL const StepWeights* graded, Int64 steps, int parent, double begin, double end,
  ParticleState* s)
{
  // Boxes may be whole at the level's time already.
  finishStraight(tables, begin, s);
  ParticleBox box;
  if (!s->IsDone)
  {
    findVelocity(tables, s->X, begin, s->V[0], s->V[0], &box);
    s->Evaluations += 1;
    s->IsUnresolved |= box.IsVoid > 0.0;
  }
  const double span = end - begin;
  for (Int64 step = 0; step < steps && !s->IsDone; ++step)
  {
    const double time = step + 1 == steps ? end : begin + span * graded[step].Time;
    takeGradedStep(tables, graded + step, span, time, s, &box);
    s->IsUnresolved |= box.IsVoid > 0.0;
    finishStraight(tables, time, s);
  }
  if (!s->IsDone && parent >= 0)
  {
    finishFromMap(map, parent, s);
  }
  return s->IsDone;
}

// The record of a node: forward its position and the last three velocities, backward its seed, with
// zeros up to a whole register.
RT_FUNCTION void writeRecord(Int64 backward, const ParticleState* s, RT_GLOBAL float* record)
{
  const int size = backward ? RT_BACKWARD_RECORD : RT_FORWARD_RECORD;
  for (int entry = backward ? RT_D : 4 * RT_D; entry < size; ++entry)
  {
    record[entry] = 0.0f;
  }
  for (int axis = 0; axis < RT_D; ++axis)
  {
    record[axis] = (float)(backward ? s->End[axis] : s->X[axis]);
    for (int k = 0; k < 3 && !backward; ++k)
    {
      record[(k + 1) * RT_D + axis] = (float)s->V[k][axis];
    }
  }
}

#endif
