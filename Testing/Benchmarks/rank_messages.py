# SPDX-License-Identifier: BSD-3-Clause
"""What rank_model.py runs on two ranks: the time of messages of VTK's controller, as
filters send them. The first rank writes the latency, and the seconds a byte.

    mpirun -np 2 pvbatch --sym rank_messages.py times.json
"""
import json
import sys
import time

from vtkmodules.vtkCommonCore import vtkCharArray
from vtkmodules.vtkParallelCore import vtkMultiProcessController

RANKS = vtkMultiProcessController.GetGlobalController()
OTHER = 1 - RANKS.GetLocalProcessId()
TAG = 52720
SMALL, LARGE = 8, 1 << 25


def array(size):
    data = vtkCharArray()
    data.SetNumberOfTuples(size)
    data.FillComponent(0, 1)
    return data


def least(action, repeats, rounds=7):
    """The least mean time of an action; other programs only make it longer."""
    times = []
    for _ in range(rounds):
        RANKS.Barrier()
        start = time.perf_counter()
        for _ in range(repeats):
            action()
        times.append((time.perf_counter() - start) / repeats)
    return min(times)


def one_way(size, repeats):
    """Half of the time there and back."""
    data = array(size)

    def there_and_back():
        if OTHER == 1:
            RANKS.Send(data, 1, TAG)
            RANKS.Receive(data, 1, TAG)
        else:
            RANKS.Receive(data, 0, TAG)
            RANKS.Send(data, 0, TAG)
    return least(there_and_back, repeats) / 2


def gathering(size, repeats):
    data, all_data = array(size), array(2 * size)
    return least(lambda: RANKS.AllGather(data, all_data), repeats)


def main(path):
    alpha = one_way(SMALL, 1000)
    found = {"alpha": alpha, "beta": (one_way(LARGE, 4) - alpha) / LARGE,
             "gather_alpha": gathering(SMALL, 1000), "gather_beta": gathering(LARGE, 4) / LARGE}
    if OTHER == 1:
        with open(path, "w", encoding="utf-8") as file:
            json.dump(found, file)


main(sys.argv[1])
