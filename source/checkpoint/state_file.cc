// SPDX-License-Identifier: LGPL-2.1-or-later
#include <keyblock/checkpoint/state_file.h>
#include <keyblock/checkpoint/state_seal.h>
#include <keyblock/checkpoint/write_through.h>

#include <hdf5.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <sstream>

namespace Keyblock
{
  namespace
  {
    /** An HDF5 handle, closed at the end of its scope. */
    class Handle
    {
    public:
      Handle(const hid_t id, herr_t (*const close)(hid_t))
        : id(id)
        , close(close)
      {}
      ~Handle()
      {
        if (id >= 0)
          close(id);
      }
      Handle(const Handle &)            = delete;
      Handle &operator=(const Handle &) = delete;

      operator hid_t() const
      {
        return id;
      }

    private:
      const hid_t id;
      herr_t (*const close)(hid_t);
    };

    hid_t
    type_of(const double)
    {
      return H5T_NATIVE_DOUBLE;
    }

    hid_t
    type_of(const unsigned int)
    {
      return H5T_NATIVE_UINT;
    }

    hid_t
    type_of(const std::uint64_t)
    {
      return H5T_NATIVE_UINT64;
    }

    hid_t
    type_of(const char)
    {
      return H5T_NATIVE_CHAR;
    }

    /** Increment of the memory that holds a new file [bytes]. */
    constexpr std::size_t memory_increment = 1 << 22;

    /** A name for a file in memory. HDF5 tells such files apart by their names
     * alone, so that no two that are open may have the same. */
    std::string
    new_name()
    {
      static unsigned int n_files = 0;
      return "state " + std::to_string(++n_files);
    }

    template <typename T>
    void
    save_list(const hid_t file,
              const std::string &entry,
              const std::vector<T> &list)
    {
      const hsize_t n = list.size();
      const Handle space(H5Screate_simple(1, &n, nullptr), H5Sclose);
      const Handle links(H5Pcreate(H5P_LINK_CREATE), H5Pclose);
      H5Pset_create_intermediate_group(links, 1);
      const Handle set(H5Dcreate2(file,
                                  entry.c_str(),
                                  type_of(T()),
                                  space,
                                  links,
                                  H5P_DEFAULT,
                                  H5P_DEFAULT),
                       H5Dclose);
      const bool is_saved =
        set >= 0 &&
        (n == 0 ||
         H5Dwrite(
           set, type_of(T()), H5S_ALL, H5S_ALL, H5P_DEFAULT, list.data()) >= 0);
      AssertThrow(is_saved,
                  dealii::ExcMessage("The entry '" + entry +
                                     "' cannot be added to a checkpoint."));
    }

    template <typename T>
    std::vector<T>
    load_list(const hid_t file,
              const std::string &entry,
              const std::string &file_name)
    {
      const Handle set(H5Dopen2(file, entry.c_str(), H5P_DEFAULT), H5Dclose);
      const Handle space(set >= 0 ? H5Dget_space(set) : -1, H5Sclose);
      const hssize_t n = space >= 0 ? H5Sget_simple_extent_npoints(space) : -1;
      // nothing is allocated that the file cannot fill
      hsize_t size        = 0;
      const bool has_list = n >= 0 && H5Fget_filesize(file, &size) >= 0 &&
                            hsize_t(n) <= size / sizeof(T);
      std::vector<T> list(has_list ? n : 0);
      const bool is_loaded =
        has_list &&
        (n == 0 ||
         H5Dread(
           set, type_of(T()), H5S_ALL, H5S_ALL, H5P_DEFAULT, list.data()) >= 0);
      AssertThrow(is_loaded,
                  InputError("The file '" + file_name +
                             "' is not a complete checkpoint: its entry '" +
                             entry +
                             "' cannot be read; name another by --restart."));
      return list;
    }

    /** The bytes of @p file, which is in memory. */
    std::vector<char>
    image_of(const hid_t file)
    {
      H5Fflush(file, H5F_SCOPE_LOCAL);
      const ssize_t size = H5Fget_file_image(file, nullptr, 0);
      std::vector<char> bytes(size > 0 ? size : 0);
      H5Fget_file_image(file, bytes.data(), bytes.size());
      return bytes;
    }

  } // namespace



  StateFile::StateFile(const Communicator &communicator)
    : communicator(communicator)
  {
    if (!communicator.is_root())
      return;
    H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
    const Handle access(H5Pcreate(H5P_FILE_ACCESS), H5Pclose);
    H5Pset_fapl_core(access, memory_increment, false);
    file = H5Fcreate(new_name().c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, access);
    AssertThrow(file >= 0,
                dealii::ExcMessage("No checkpoint can be put together."));
  }



  StateFile::StateFile(const Communicator &communicator,
                       const std::string &name)
    : communicator(communicator)
    , name(name)
  {
    communicator.on_root([&]() {
      H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
      check_seal(name);
      file = H5Fopen(name.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT);
      AssertThrow(file >= 0,
                  InputError("The file '" + name +
                             "' is not a checkpoint; name one by --restart."));
    });
  }



  StateFile::StateFile(const Communicator &communicator,
                       std::vector<char> &image)
    : communicator(communicator)
    , name("state of the run")
  {
    if (!communicator.is_root())
      return;
    H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
    const Handle access(H5Pcreate(H5P_FILE_ACCESS), H5Pclose);
    H5Pset_fapl_core(access, memory_increment, false);
    H5Pset_file_image(access, image.data(), image.size());
    file = H5Fopen(new_name().c_str(), H5F_ACC_RDONLY, access);
    AssertThrow(file >= 0,
                dealii::ExcMessage("The state of the run cannot be read."));
  }



  StateFile::~StateFile()
  {
    if (file >= 0)
      H5Fclose(file);
  }



  template <typename T>
  void
  StateFile::exchange_list(const std::string &entry, std::vector<T> &list)
  {
    if (is_read())
      {
        communicator.on_root([&]() { list = load_list<T>(file, entry, name); });
        communicator.broadcast(list);
      }
    else if (communicator.is_root())
      save_list(file, entry, list);
  }



  void
  StateFile::exchange(const std::string &entry, std::vector<double> &list)
  {
    exchange_list(entry, list);
  }



  void
  StateFile::exchange(const std::string &entry, std::vector<unsigned int> &list)
  {
    exchange_list(entry, list);
  }



  void
  StateFile::exchange(const std::string &entry,
                      std::vector<std::uint64_t> &list)
  {
    exchange_list(entry, list);
  }



  void
  StateFile::exchange(const std::string &entry, std::string &text)
  {
    std::vector<char> list(text.begin(), text.end());
    exchange_list(entry, list);
    text.assign(list.begin(), list.end());
  }



  void
  StateFile::exchange(const std::string &entry, double &value)
  {
    std::vector<double> list = {value};
    exchange_list(entry, list);
    value = list.at(0);
  }



  void
  StateFile::exchange(const std::string &entry, unsigned int &value)
  {
    std::vector<unsigned int> list = {value};
    exchange_list(entry, list);
    value = list.at(0);
  }



  void
  StateFile::exchange(const std::string &entry, std::uint64_t &value)
  {
    std::vector<std::uint64_t> list = {value};
    exchange_list(entry, list);
    value = list.at(0);
  }



  void
  StateFile::exchange(const std::string &entry, bool &value)
  {
    unsigned int number = value;
    exchange(entry, number);
    value = number != 0;
  }



  void
  StateFile::exchange(const std::string &entry, std::vector<bool> &list)
  {
    std::vector<unsigned int> numbers(list.begin(), list.end());
    exchange_list(entry, numbers);
    list.assign(numbers.begin(), numbers.end());
  }



  void
  StateFile::exchange(const std::string &entry, std::vector<std::string> &list)
  {
    std::string text;
    for (const std::string &line : list)
      text += line + '\n';
    exchange(entry, text);
    list.clear();
    std::istringstream lines(text);
    for (std::string line; std::getline(lines, line);)
      list.push_back(line);
  }



  void
  StateFile::exchange_shares(const std::string &entry,
                             const std::vector<double *> &values)
  {
    const std::size_t n = values.size();
    std::vector<double> list(n * communicator.size(), 0.), shares(n);
    std::transform(values.begin(),
                   values.end(),
                   shares.begin(),
                   [](const double *value) { return *value; });
    MPI_Allgather(
      shares.data(), n, MPI_DOUBLE, list.data(), n, MPI_DOUBLE, communicator);
    exchange_list(entry, list);
    if (!is_read())
      return;
    const bool has_same_ranks = list.size() == n * communicator.size();
    for (std::size_t i = 0; i < n; ++i)
      {
        double sum = 0.;
        for (std::size_t k = i; k < list.size(); k += n)
          sum += list[k];
        *values[i] = has_same_ranks ? list[n * communicator.rank() + i]
                     : communicator.is_root() ? sum
                                              : 0.;
      }
  }



  std::vector<char>
  StateFile::image() const
  {
    std::vector<char> bytes;
    if (communicator.is_root())
      bytes = image_of(file);
    communicator.broadcast(bytes);
    return bytes;
  }



  std::string
  StateFile::write(const std::string &file_name) const
  {
    std::string failure;
    if (communicator.is_root())
      {
        const std::string part = file_name + ".part";
        if (!write_through(part, image_of(file)) ||
            std::rename(part.c_str(), file_name.c_str()) != 0)
          {
            failure = std::strerror(errno);
            unlink(part.c_str());
          }
      }
    return communicator.text_of_root(failure);
  }
} // namespace Keyblock
