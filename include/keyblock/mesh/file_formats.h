// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef keyblock_mesh_file_formats_h
#define keyblock_mesh_file_formats_h

#include <keyblock/mesh/cut.h>

#include <istream>
#include <stdexcept>
#include <string>

// Readers of mesh files, and what they share. All throw std::runtime_error with
// what is wrong.
namespace Keyblock
{
  /** The next number or word. Throws std::runtime_error at the end. */
  template <typename Value>
  Value
  next(std::istream &in, const std::string &what)
  {
    Value value;
    if (!(in >> value))
      throw std::runtime_error("no " + what + " where one is expected");
    return value;
  }

  /** The same for how many items follow, each of at least a digit and a
   * blank: more than the rest of the file can hold is not allocated. */
  unsigned int next_count(std::istream &in, const std::string &what);

  /** A word as a number. Throws std::runtime_error if it is none. */
  unsigned long whole_number(const std::string &word);
  double real_number(const std::string &word);

  /** Put an element among the cells or the faces, or drop it. */
  void add_element(MixedMesh &mixed,
                   const MixedMesh::Element &element,
                   const unsigned int dimension,
                   const unsigned int dim);

  /** AVS UCD: ids are the material numbers of the elements. */
  MixedMesh read_ucd(std::istream &in, const unsigned int dim);

  /** Legacy VTK of unstructured grids in ASCII. */
  MixedMesh read_vtk(std::istream &in, const unsigned int dim);

  /** Abaqus input. Ids are the numbers at the end of the names of element
   * sets: that of *ELEMENT, or that of the last *ELSET naming the element. */
  MixedMesh read_abaqus(std::istream &in, const unsigned int dim);
} // namespace Keyblock

#endif
