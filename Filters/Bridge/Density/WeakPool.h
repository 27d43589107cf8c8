// SPDX-License-Identifier: BSD-3-Clause
// Objects that several filters share while one of them owns them, by what they were made from.
#ifndef RectifiedTransport_WeakPool_h
#define RectifiedTransport_WeakPool_h

#include <algorithm>
#include <memory>
#include <mutex>
#include <utility>
#include <vector>

namespace RectifiedTransport::Bridge
{

// All objects have one type, which the caller knows. Any thread may call it.
template <class Key>
class WeakPool
{
public:
  // nullptr if nobody owns an object of this key.
  template <class T>
  std::shared_ptr<const T> Find(const Key& key) const
  {
    const std::lock_guard<std::mutex> lock(this->Mutex);
    for (const auto& [of, seen] : this->Entries)
    {
      if (of == key)
      {
        if (const std::shared_ptr<const void> found = seen.lock())
        {
          return std::static_pointer_cast<const T>(found);
        }
      }
    }
    return nullptr;
  }

  void Insert(const Key& key, const std::shared_ptr<const void>& made)
  {
    const std::lock_guard<std::mutex> lock(this->Mutex);
    const auto isGone = [](const Entry& entry) { return entry.second.expired(); };
    this->Entries.erase(
      std::remove_if(this->Entries.begin(), this->Entries.end(), isGone), this->Entries.end());
    this->Entries.emplace_back(key, made);
  }

private:
  using Entry = std::pair<Key, std::weak_ptr<const void>>;

  mutable std::mutex Mutex;
  std::vector<Entry> Entries;
};

} // namespace RectifiedTransport::Bridge

#endif
