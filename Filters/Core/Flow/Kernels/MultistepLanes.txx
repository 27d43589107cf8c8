// SPDX-License-Identifier: BSD-3-Clause
// The state of a block of particles in a multistep method. Included by FlowKernels.txx.

// The state of a multistep method: positions and the velocities of the last steps. A step is
//   x_k+1 = x_k + Span * Length * (weighted sum of three velocities),
// where Span is that of each lane, and Length and weights are those of all (StepWeights).
template <int Dimension>
struct MultistepLanes
{
  alignas(64) LaneVectors<Dimension> Position;      // x_k
  alignas(64) LaneVectors<Dimension> Trial;         // the prediction of x_k+1
  alignas(64) LaneVectors<Dimension> Velocities[4]; // memory of V
  LaneVectors<Dimension>* V[4];                     // v_k, v_k-1, v_k-2, and output
  alignas(64) Lanes Time;                           // of Trial; after the step that of Position
  alignas(64) Lanes Span;                           // length of the graded interval
  alignas(64) Lanes Unresolved;                     // 1 once a box was empty
  VelocityLanes<Dimension> Field;

  MultistepLanes()
  {
    for (int k = 0; k < 4; ++k)
    {
      this->V[k] = &this->Velocities[k];
    }
    // Velocities that are not known yet have the weight 0, and lanes that are not summed have no
    // mass: their products must not be NaN of what was in memory.
    std::memset(this->Velocities, 0, sizeof(this->Velocities));
    std::memset(this->Unresolved, 0, sizeof(this->Unresolved));
    std::memset(this->Field.Outside, 0, sizeof(this->Field.Outside));
    std::memset(this->Field.Boxes.Mass, 0, sizeof(this->Field.Boxes.Mass));
    std::memset(this->Field.Boxes.Moment, 0, sizeof(this->Field.Boxes.Moment));
  }

  // After a step: the output becomes the newest velocity, and the oldest one's memory takes the
  // next output. Moves pointers alone.
  void Rotate()
  {
    LaneVectors<Dimension>* oldest = this->V[2];
    this->V[2] = this->V[1];
    this->V[1] = this->V[0];
    this->V[0] = this->V[3];
    this->V[3] = oldest;
  }

  // result = Position + Span * (a[0] first + a[1] second + a[2] third), kept in the domain.
  RT_INLINE void Advance(const FlowJob<Dimension>& job, const double a[3], double length,
    const LaneVectors<Dimension>& first, const LaneVectors<Dimension>& second,
    const LaneVectors<Dimension>& third, LaneVectors<Dimension>& result)
  {
    for (int axis = 0; axis < Dimension; ++axis)
    {
      const double size = job.Tables.Size[axis];
#pragma omp simd
      for (int i = 0; i < BlockSize; ++i)
      {
        result[axis][i] = advance(this->Position[axis][i], this->Span[i], length, a[0], a[1], a[2],
          first[axis][i], second[axis][i], third[axis][i], size);
      }
    }
  }
};

// Particles whose box lies in a plateau (isFull): their end is known, and exact. Densities with
// empty cells are most often shapes of one value, where nearly all boxes become such.
template <int Dimension>
struct PlateauLanes
{
  alignas(64) LaneVectors<Dimension> End; // x(1)
  alignas(64) Lanes Done;                 // 1 where End is known, else 0
  bool Active[BlockSize];                 // lanes that are not done
  int Left = BlockSize;                   // how many

  PlateauLanes()
  {
    std::memset(this->End, 0, sizeof(this->End));
    std::memset(this->Done, 0, sizeof(this->Done));
    std::memset(this->Active, 1, sizeof(this->Active));
  }

  // Counts lanes as done that shall not be computed.
  void Exclude(const bool (&lanes)[BlockSize])
  {
    for (int i = 0; i < BlockSize; ++i)
    {
      this->Active[i] = !lanes[i];
      this->Done[i] = lanes[i] ? 1.0 : 0.0;
      this->Left -= lanes[i] ? 1 : 0;
    }
  }

  // After an evaluation of the velocity in `field`, with particles at x. Marks in `found` the lanes
  // that are done since the last call, and returns whether there are any.
  RT_INLINE bool Find(const FlowJob<Dimension>& job, const VelocityLanes<Dimension>& field,
    const LaneVectors<Dimension>& x, Lanes& found)
  {
    alignas(64) Lanes mass; // the largest that the box could hold: maximum times volume
#pragma omp simd
    for (int i = 0; i < BlockSize; ++i)
    {
      mass[i] = job.Tables.Largest;
    }
    for (int axis = 0; axis < Dimension; ++axis)
    {
      const double size = job.Tables.Size[axis];
#pragma omp simd
      for (int i = 0; i < BlockSize; ++i)
      {
        mass[i] = withSide(mass[i], field.From[axis][i], field.To[axis][i], size);
      }
    }
    // A sum of 0s and 1s is exact in any order.
    double sum = 0.0;
#pragma omp simd reduction(+ : sum)
    for (int i = 0; i < BlockSize; ++i)
    {
      const bool full = isFull(mass[i], field.Boxes.Mass[i]); // Mass is 1 / mass here
      found[i] = full && field.Void[i] == 0.0 && this->Done[i] == 0.0 ? 1.0 : 0.0;
      this->Done[i] += found[i];
      sum += found[i];
    }
    if (sum == 0.0)
    {
      return false;
    }
    for (int i = 0; i < BlockSize; ++i)
    {
      this->Active[i] = this->Done[i] == 0.0;
    }
    for (int axis = 0; axis < Dimension; ++axis)
    {
      const double half = 0.5 * job.Tables.Size[axis];
#pragma omp simd
      for (int i = 0; i < BlockSize; ++i)
      {
        const double centre = centreOfBox(x[axis][i], half, field.InverseTime[i]);
        this->End[axis][i] = found[i] > 0.0 ? centre : this->End[axis][i];
      }
    }
    this->Left -= static_cast<int>(sum);
    return true;
  }
};
