// SPDX-License-Identifier: BSD-3-Clause
// The flow of one particle in RT_D dimensions, 2 or 3: what a work item of a device does. The
// multistep method as in FlowMultistep.txx and FlowMultistepBackward.txx, on whole tables.
#ifndef RectifiedTransport_Particle_h
#define RectifiedTransport_Particle_h

// Forward records are whole registers; those of the way back are four floats.
#define RT_FORWARD_RECORD (RT_D == 3 ? 16 : 8)
#define RT_BACKWARD_RECORD 4

typedef struct
{
  RT_CONSTANT const FlowInput* Input;
  RT_GLOBAL const double* Fine;     // records of the finest level, 4 doubles a node
  RT_GLOBAL const double* Coarse;   // records of all other levels
  RT_GLOBAL const Bits64* Occupied; // read if there are empty cells
} TableInput;

typedef struct
{
  Int64 Steps; // the steps of particles that hand over
  Int64 LevelCount;
  RT_CONSTANT const MapLevelInput* Levels;
  RT_GLOBAL const float* Records; // those of all levels, one level after the other
  RT_GLOBAL const Byte* Bad;      // 1 for a lattice cell that must not be interpolated
} MapInput;

typedef struct
{
  double X[RT_D];    // position in cells
  double V[3][RT_D]; // the last velocities, newest first
  double End[RT_D];  // x(1), or backwards the seed, once it is known
  double Start;      // time at which the graded interval begins
  Int32 IsDone;      // End is known
  Int32 IsUnresolved;
  Int32 Evaluations; // velocity evaluations so far
} ParticleState;

typedef struct
{
  double From[RT_D];  // a, the low corner of the clipped box
  double To[RT_D];    // b, the high corner
  double InverseTime; // 1 / t
  double InverseMass; // 1 / the integral of f over the box
  double IsVoid;      // 1 or 0
} ParticleBox;

// The sides of a box among the nodes of a level. [axis][0] is the low side, [axis][1] the high one.
typedef struct
{
  double Node[RT_D][2];            // below the side
  double Place[RT_D][2];           // r, from 0 to 1 between the nodes
  double QuadraticWeight[RT_D][2]; // b = -(h/2) r (1 - r)
  double MomentWeight[RT_D][2];    // in 3D
  int Faces[RT_D];                 // bits: whether the sides are on faces of the domain
} BoxNodes;

// The mass and moments of a box on a level of the tables (Eqs. 10 and 11 of the paper need both).
RT_FUNCTION void sumTables(
  const TableInput* tables, Int32 level, const BoxNodes* box, double* mass, double* moments)
{
  RT_CONSTANT const Int64* strides = tables->Input->Stride[level];
  RT_GLOBAL const double* nodes =
    level == 0 ? tables->Fine : tables->Coarse + tables->Input->Offset[level];
  const int isOnLowFace0 = box->Faces[0] & RT_LOW_FACE;
#if RT_D == 3
  if (level == 0)
  {
    FineAxis axes[2];
    for (int side = 0; side < 2; ++side)
    {
      axes[0].Weights[side] = RT_FILL4_BUT(2, box->Place[1][side], box->MomentWeight[1][side]);
      axes[1].Weights[side] = RT_FILL4_BUT(3, box->Place[2][side], box->MomentWeight[2][side]);
      axes[0].Offset[side] = (Int64)box->Node[1][side] * strides[1];
      axes[1].Offset[side] = (Int64)box->Node[2][side] * strides[2];
    }
    axes[0].Stride = strides[1];
    axes[1].Stride = strides[2];
    sumFineBox3D(nodes + (Int64)box->Node[0][0] * strides[0],
      nodes + (Int64)box->Node[0][1] * strides[0], box->Place[0][0], box->MomentWeight[0][0],
      box->Place[0][1], box->MomentWeight[0][1], &axes[0], &axes[1], isOnLowFace0, box->Faces[1],
      box->Faces[2], mass, moments);
    return;
  }
#endif
  BoxAxis axes[RT_D];
  for (int axis = 0; axis < RT_D; ++axis)
  {
    for (int side = 0; side < 2; ++side)
    {
      axes[axis].Place[side] = box->Place[axis][side];
      axes[axis].QuadraticWeight[side] = box->QuadraticWeight[axis][side];
      axes[axis].Offset[side] = (Int64)box->Node[axis][side] * strides[axis];
    }
    axes[axis].Stride = strides[axis];
  }
#if RT_D == 3
  sumCoarseBox3D(
    nodes, &axes[0], &axes[1], &axes[2], isOnLowFace0, box->Faces[1], box->Faces[2], mass, moments);
#else
  sumBox2D(nodes, &axes[0], &axes[1], isOnLowFace0, box->Faces[1], mass, &moments[0], &moments[1]);
#endif
}

// v(x, t). Forwards an empty box gives `held`. Needs 0 < t < 1.
RT_FUNCTION void findVelocity(const TableInput* tables, const double* x, double t,
  const double* held, double* v, ParticleBox* box)
{
  RT_CONSTANT const FlowInput* input = tables->Input;
  double inverseRest;
  double centre[RT_D];
  // The narrowest side chooses the level of the tables.
  double narrowest = 1e300;
  BoxNodes sides;
  invertTimes(t, &box->InverseTime, &inverseRest);
  for (int axis = 0; axis < RT_D; ++axis)
  {
    const double size = input->Size[axis];
    findSides(x[axis], size, box->InverseTime, &box->From[axis], &box->To[axis], &centre[axis]);
    narrowest = smaller(narrowest, box->To[axis] - box->From[axis]);
    sides.Faces[axis] = (box->From[axis] <= 0.0 ? RT_LOW_FACE : 0) |
      (axis > 0 && box->To[axis] >= size ? RT_HIGH_FACE : 0);
  }
  double width;
  double inverseWidth;
  Int32 level;
  findLevel(narrowest, input->InverseRatio, input->Widest, &width, &inverseWidth, &level);
  for (int axis = 0; axis < RT_D; ++axis)
  {
    // A level whose cells do not divide the domain has a narrower last cell.
    const int even = input->EvenLevels[axis] != 0;
    double last;
    double lastWidth;
    double inverseLastWidth;
    findLastCell(
      input->Size[axis], width, inverseWidth, even, &last, &lastWidth, &inverseLastWidth);
    for (int side = 0; side < 2; ++side)
    {
      findNode(side == 0 ? box->From[axis] : box->To[axis], width, inverseWidth, last, lastWidth,
        inverseLastWidth, even, &sides.Node[axis][side], &sides.Place[axis][side],
        &sides.QuadraticWeight[axis][side]);
    }
    if (RT_D == 3)
    {
      findMomentWeights(sides.Node[axis][0], sides.Place[axis][0], sides.Node[axis][1],
        sides.Place[axis][1], &sides.MomentWeight[axis][0], &sides.MomentWeight[axis][1]);
    }
  }
  double mass;
  double moments[RT_D];
  sumTables(tables, level, &sides, &mass, moments);
  // Rounding of the sums alone is a mass up to VoidMass.
  box->IsVoid = mass > input->VoidMass ? 0.0 : 1.0;
  box->InverseMass = 1.0 / mass;
  for (int axis = 0; axis < RT_D; ++axis)
  {
    const double value = velocityInBox(x[axis], t, 0.5 * input->Size[axis], box->From[axis],
      box->To[axis], centre[axis], moments[axis], box->InverseMass, box->IsVoid, inverseRest);
    // In a void a forward particle keeps its last velocity; backward it keeps its place in the box.
    v[axis] = box->IsVoid > 0.0 && !input->Backward ? held[axis] : value;
  }
}

// A step to `time`: predictor p, velocity (at time 0 its limit M - x, without a box), corrector c.
RT_FUNCTION void takeStep(const TableInput* tables, const double* p, const double* c, double span,
  double length, double time, ParticleState* s, ParticleBox* box)
{
  RT_CONSTANT const FlowInput* input = tables->Input;
  double trial[RT_D];
  double newest[RT_D];
  for (int axis = 0; axis < RT_D; ++axis)
  {
    trial[axis] = advance(s->X[axis], span, length, p[0], p[1], p[2], s->V[0][axis], s->V[1][axis],
      s->V[2][axis], input->Size[axis]);
  }
  if (time <= 0.0)
  {
    box->IsVoid = 0.0;
    box->InverseTime = 0.0;
    box->InverseMass = 0.0;
    for (int axis = 0; axis < RT_D; ++axis)
    {
      newest[axis] = input->Centroid[axis] - trial[axis];
    }
  }
  else
  {
    findVelocity(tables, trial, time, s->V[0], newest, box);
    s->Evaluations += 1;
  }
  for (int axis = 0; axis < RT_D; ++axis)
  {
    s->X[axis] = advance(s->X[axis], span, length, c[0], c[1], c[2], newest[axis], s->V[0][axis],
      s->V[1][axis], input->Size[axis]);
    // The newest velocity moves to the front of the history.
    s->V[2][axis] = s->V[1][axis];
    s->V[1][axis] = s->V[0][axis];
    s->V[0][axis] = newest[axis];
  }
}

// A step with the common weights of the graded times.
RT_FUNCTION void takeGradedStep(const TableInput* tables, RT_GLOBAL const StepWeights* weights,
  double span, double time, ParticleState* s, ParticleBox* box)
{
  double p[3];
  double c[3];
  for (int k = 0; k < 3; ++k)
  {
    p[k] = weights->Predictor[k];
    c[k] = weights->Corrector[k];
  }
  takeStep(tables, p, c, span, weights->Length, time, s, box);
}

// A particle that has not moved from its seed.
RT_FUNCTION void placeParticle(const TableInput* tables, const double* seed, ParticleState* s)
{
  for (int axis = 0; axis < RT_D; ++axis)
  {
    s->X[axis] = clampToDomain(seed[axis], tables->Input->Size[axis]);
    s->V[0][axis] = 0.0;
    s->V[1][axis] = 0.0;
    s->V[2][axis] = 0.0;
    s->End[axis] = 0.0;
  }
  s->Start = 0.0;
  s->IsDone = 0;
  s->IsUnresolved = 0;
}

// From its seed to the end of its straight start.
RT_FUNCTION void advanceStraightStart(const TableInput* tables, ParticleState* s)
{
  double time = 1.0;
  for (int axis = 0; axis < RT_D; ++axis)
  {
    const double centroid = tables->Input->Centroid[axis];
    // t* = min over axes: the first time at which a side of the box leaves its face.
    time = smaller(time, endOfStraightStart(s->X[axis], tables->Input->Size[axis], centroid));
    s->V[0][axis] = centroid - s->X[axis];
  }
  for (int axis = 0; axis < RT_D; ++axis)
  {
    s->X[axis] += time * s->V[0][axis];
  }
  s->Start = time;
}

// Interpolates `parts` times four floats of the records at a place. Returns whether the cell of the
// lattice may be interpolated; else nothing is read.
RT_FUNCTION int readMap(
  const MapInput* map, int levelNumber, const double* x, int record, int parts, Float4* result)
{
  RT_CONSTANT const MapLevelInput* level = map->Levels + levelNumber;
  float weights[RT_D][4];
  Int64 cell = 0;
  Int64 node = 0;
  for (int axis = RT_D - 1; axis >= 0; --axis)
  {
    Int32 in;
    Int32 first;
    findStencil(x[axis], level->Size[axis], level->Layer[axis], level->Length[axis],
      level->InverseSpacing[axis], (double)(level->Cells[axis] - 1), &in, &first, &weights[axis][0],
      &weights[axis][1], &weights[axis][2], &weights[axis][3]);
    cell = cell * level->Cells[axis] + in;
    node = node * (level->Cells[axis] + 1) + first;
  }
  if (map->Bad[level->FirstCell + cell])
  {
    return 0;
  }
  // Cubic Lagrange interpolation, axis by axis, from 4^RT_D nodes.
  const Int64 stride1 = record * (level->Cells[0] + 1);
  for (int part = 0; part < parts; ++part)
  {
    RT_GLOBAL const float* corner = map->Records + level->FirstRecord + node * record + 4 * part;
    Float4 columns[4];
    for (int k = 0; k < 4; ++k)
    {
      Float4 rows[4];
      for (int j = 0; j < 4; ++j)
      {
        RT_GLOBAL const float* row = corner + k * record + j * stride1;
#if RT_D == 3
        const Int64 stride2 = stride1 * (level->Cells[1] + 1);
        rows[j] =
          (RT_LOAD_FLOATS(row) * weights[2][0] + RT_LOAD_FLOATS(row + stride2) * weights[2][1]) +
          (RT_LOAD_FLOATS(row + 2 * stride2) * weights[2][2] +
            RT_LOAD_FLOATS(row + 3 * stride2) * weights[2][3]);
#else
        rows[j] = RT_LOAD_FLOATS(row);
#endif
      }
      columns[k] = (rows[0] * weights[1][0] + rows[1] * weights[1][1]) +
        (rows[2] * weights[1][2] + rows[3] * weights[1][3]);
    }
    result[part] = (columns[0] * weights[0][0] + columns[1] * weights[0][1]) +
      (columns[2] * weights[0][2] + columns[3] * weights[0][3]);
  }
  return 1;
}

// To the hand-over of a level of the map. Returns whether its cell may be read: else nothing is
// changed.
RT_FUNCTION int advanceToHandOver(
  const TableInput* tables, const MapInput* map, int level, ParticleState* s)
{
  Float4 parts[RT_D];
  if (!readMap(map, level, s->X, RT_FORWARD_RECORD, RT_D, parts))
  {
    return 0;
  }
  float state[4 * RT_D];
  for (int part = 0; part < RT_D; ++part)
  {
    // A record is the position and three velocities, RT_D floats each.
    state[4 * part] = RT_ENTRY(parts[part], 0);
    state[4 * part + 1] = RT_ENTRY(parts[part], 1);
    state[4 * part + 2] = RT_ENTRY(parts[part], 2);
    state[4 * part + 3] = RT_ENTRY(parts[part], 3);
  }
  for (int axis = 0; axis < RT_D; ++axis)
  {
    s->X[axis] = clampToDomain((double)state[axis], tables->Input->Size[axis]);
    for (int k = 0; k < 3; ++k)
    {
      s->V[k][axis] = (double)state[(k + 1) * RT_D + axis];
    }
  }
  s->Start = RT_COMMON_START;
  return 1;
}

// Steps [first, last) of `steps`, but the last of all. Stops where the particle is done and, if it
// may be given up, where it met an empty box.
RT_FUNCTION void stepForward(const TableInput* tables, RT_GLOBAL const StepWeights* weights,
  Int64 steps, Int64 first, Int64 last, int mayGiveUp, ParticleState* s)
{
  RT_CONSTANT const FlowInput* input = tables->Input;
  const double span = 1.0 - s->Start;
  // The last step of all is implicit and closed (finishForward).
  const Int64 end = last < steps - 1 ? last : steps - 1;
  for (Int64 step = first; step < end && !s->IsDone && !(mayGiveUp && s->IsUnresolved); ++step)
  {
    ParticleBox box;
    takeGradedStep(tables, weights + step, span, s->Start + span * weights[step].Time, s, &box);
    // A box of less mass than this may count as empty by rounding alone.
    double mostMass = RT_LEAST_PART * input->Largest;
    for (int axis = 0; axis < RT_D; ++axis)
    {
      mostMass *= box.To[axis] - box.From[axis];
    }
    s->IsUnresolved |= mostMass > input->VoidMass && box.IsVoid > 0.0;
    // Where the box's mass is its volume times the largest value, it is uniformly full: then the
    // rest of the path is known, as x(1) is the box's centre.
    if (input->HasEmptyCells && 3 * step >= steps)
    {
      double mass = input->Largest;
      for (int axis = 0; axis < RT_D; ++axis)
      {
        mass = withSide(mass, box.From[axis], box.To[axis], input->Size[axis]);
      }
      s->IsDone = isFull(mass, box.InverseMass) && box.IsVoid == 0.0;
      for (int axis = 0; axis < RT_D; ++axis)
      {
        s->End[axis] = centreOfBox(s->X[axis], 0.5 * input->Size[axis], box.InverseTime);
      }
    }
  }
}

// Whether the grid cell of a point has mass. Points on the high faces belong to the last cell.
RT_FUNCTION int isInMass(const TableInput* tables, const double* x)
{
  RT_CONSTANT const FlowInput* input = tables->Input;
  if (!input->HasEmptyCells)
  {
    return 1;
  }
  Int64 cell[RT_D];
  for (int axis = 0; axis < RT_D; ++axis)
  {
    const Int64 last = input->Cells[axis] - 1;
    cell[axis] = (Int64)x[axis];
    cell[axis] = cell[axis] < last ? cell[axis] : last;
  }
  Int64 row = 0;
  for (int axis = RT_D - 1; axis > 0; --axis)
  {
    row = row * input->Cells[axis] + cell[axis];
  }
  // A bit for each cell, 64 in a word, rows along axis 0.
  const Bits64 word = tables->Occupied[row * input->WordsPerRow + (cell[0] >> 6)];
  return (int)((word >> (cell[0] & 63)) & 1);
}

// The last step: x(1), in the domain. Sets IsUnresolved where that is in an empty cell, too.
RT_FUNCTION void finishForward(
  const TableInput* tables, RT_GLOBAL const StepWeights* last, ParticleState* s)
{
  for (int axis = 0; axis < RT_D; ++axis)
  {
    const double size = tables->Input->Size[axis];
    // x(1) in closed form, from the implicit last step (closedEnd).
    const double end = s->IsDone
      ? s->End[axis]
      : closedEnd(s->X[axis], 1.0 - s->Start, last->Length, last->Corrector[0], last->Corrector[1],
          last->Corrector[2], s->V[0][axis], s->V[1][axis], 0.5 * size);
    s->End[axis] = smaller(larger(end, 0.0), size);
  }
  s->IsUnresolved |= !isInMass(tables, s->End);
}

// Where particles of the way back start: at time 1, whose velocity is x - S/2.
RT_FUNCTION void startBackward(const TableInput* tables, ParticleState* s)
{
  for (int axis = 0; axis < RT_D; ++axis)
  {
    s->V[0][axis] = s->X[axis] - 0.5 * tables->Input->Size[axis];
  }
}

// If the box is the whole domain, End becomes the seed.
RT_FUNCTION void finishStraight(const TableInput* tables, double time, ParticleState* s)
{
  RT_CONSTANT const FlowInput* input = tables->Input;
  int whole = 1;
  for (int axis = 0; axis < RT_D && time > 0.0; ++axis)
  {
    whole = whole && isWhole(s->X[axis], time, input->Size[axis]);
  }
  if (whole)
  {
    for (int axis = 0; axis < RT_D; ++axis)
    {
      // x0 = (x - t M) / (1 - t): the path is straight while the box is the whole domain.
      s->End[axis] = seedOfStraight(s->X[axis], time, input->Size[axis], input->Centroid[axis]);
    }
    s->IsDone = 1;
  }
}

// If the cell of a level may be interpolated, End becomes the seed.
RT_FUNCTION void finishFromMap(const MapInput* map, int level, ParticleState* s)
{
  Float4 seed[1];
  if (readMap(map, level, s->X, RT_BACKWARD_RECORD, 1, seed))
  {
    s->End[0] = smaller(larger((double)RT_ENTRY(seed[0], 0), 0.0), map->Levels[level].Size[0]);
    s->End[1] = smaller(larger((double)RT_ENTRY(seed[0], 1), 0.0), map->Levels[level].Size[1]);
#if RT_D == 3
    s->End[2] = smaller(larger((double)RT_ENTRY(seed[0], 2), 0.0), map->Levels[level].Size[2]);
#endif
    s->IsDone = 1;
  }
}

// Steps [first, last) of `steps`; a step may end at the time of a level of the map, the finest
// first.
RT_FUNCTION void stepBackward(const TableInput* tables, const MapInput* map,
  RT_GLOBAL const StepWeights* weights, Int64 steps, Int64 first, Int64 last, ParticleState* s)
{
  for (Int64 step = first; step < last && !s->IsDone; ++step)
  {
    // The last step ends at 0, whatever the rounding.
    const double time = step + 1 == steps ? 0.0 : 1.0 - weights[step].Time;
    ParticleBox box;
    takeGradedStep(tables, weights + step, -1.0, time, s, &box);
    for (int level = 0; level < map->LevelCount && !s->IsDone; ++level)
    {
      if (step + 1 == map->Levels[level].HandOver)
      {
        finishFromMap(map, level, s);
      }
    }
    if (!s->IsDone)
    {
      finishStraight(tables, time, s);
    }
  }
}

#endif
