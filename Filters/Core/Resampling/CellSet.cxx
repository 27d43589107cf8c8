// SPDX-License-Identifier: BSD-3-Clause
#include "Core/Resampling/CellSet.h"

#include <algorithm>

namespace RectifiedTransport
{

CellSet::~CellSet() = default;

bool CellSet::HiddenFlags::HasAny(const CellReader::Ids& ids) const
{
  return this->Flags &&
    std::any_of(ids.begin(), ids.end(), [this](std::int64_t id) { return this->Has(id); });
}

} // namespace RectifiedTransport
