// SPDX-License-Identifier: BSD-3-Clause
#include "Bridge/Store/Store.h"

#include <algorithm>
#include <mutex>
#include <typeindex>
#include <vector>

namespace RectifiedTransport::Bridge
{

namespace
{

struct Entry
{
  std::type_index Type;
  DataIdentity Of;
  std::weak_ptr<void> Object;
};

// The objects in use by any filter of the process.
struct Entries
{
  static Entries& Get()
  {
    static Entries entries;
    return entries;
  }

  std::mutex Mutex;
  std::vector<Entry> All;
};

} // namespace

std::shared_ptr<void> Store::find(const std::type_info& type, const DataIdentity& of)
{
  Entries& entries = Entries::Get();
  const std::lock_guard<std::mutex> lock(entries.Mutex);
  for (const Entry& entry : entries.All)
  {
    if (entry.Type == type && of.IsByContent(entry.Of))
    {
      if (std::shared_ptr<void> found = entry.Object.lock())
      {
        return found;
      }
    }
  }
  return nullptr;
}

void Store::insert(
  const std::type_info& type, const DataIdentity& of, const std::shared_ptr<void>& object)
{
  Entries& entries = Entries::Get();
  const std::lock_guard<std::mutex> lock(entries.Mutex);
  const auto isGone = [](const Entry& entry) { return entry.Object.expired(); };
  entries.All.erase(
    std::remove_if(entries.All.begin(), entries.All.end(), isGone), entries.All.end());
  entries.All.push_back({ type, of, object });
}

bool Store::withdraw(const std::shared_ptr<void>& object)
{
  Entries& entries = Entries::Get();
  const std::lock_guard<std::mutex> lock(entries.Mutex);
  if (object.use_count() != 1)
  {
    return false;
  }
  const auto is = [&](const Entry& entry) { return entry.Object.lock() == object; };
  entries.All.erase(std::remove_if(entries.All.begin(), entries.All.end(), is), entries.All.end());
  return true;
}

} // namespace RectifiedTransport::Bridge
