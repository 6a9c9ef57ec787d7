// SPDX-License-Identifier: LGPL-2.1-or-later
// Block theory for people and for summary.json.
#include <keyblock/safety/block_theory.h>

#include <nlohmann/json.hpp>

#include <cmath>
#include <iomanip>
#include <ostream>

namespace Keyblock
{
  namespace
  {
    using Json = nlohmann::ordered_json;

    /** Angle below the horizontal [deg]. */
    template <int dim>
    double
    dip_of(const ParallelJoints<dim> &set)
    {
      return std::acos(std::min(1., set.normal[dim - 1])) * 180. /
             dealii::numbers::PI;
    }

    /** Azimuth towards which it descends, from 0 to 360 [deg]. */
    template <int dim>
    double
    dip_direction_of(const ParallelJoints<dim> &set)
    {
      const double north = dim == 3 ? set.normal[1] : 0.;
      const double angle =
        std::atan2(set.normal[0], north) * 180. / dealii::numbers::PI;
      // a plane that descends to 359.99999 descends to 0
      return angle < -1e-6 ? angle + 360. : std::max(0., angle);
    }

    template <int dim>
    bool
    has_wedges(const BlockTheory<dim> &theory, const FreeFace<dim> &face)
    {
      return dim == 3 && theory.settings.roof_span > 0. && face.name == "roof";
    }

    /** Largest block of the pyramid @p code; nothing in 2D. */
    template <int dim>
    RoofWedge
    wedge_of(const BlockTheory<dim> &theory, const std::string &code)
    {
      if constexpr (dim == 3)
        return find_largest_roof_wedge(theory.sets, code, theory.settings);
      else
        return RoofWedge();
    }

    template <int dim>
    void
    print_sets(std::ostream &out, const BlockTheory<dim> &theory)
    {
      out << "  set  joint           dip [deg]  dip direction  friction angle\n"
          << std::fixed << std::setprecision(1);
      for (unsigned int s = 0; s < theory.sets.size(); ++s)
        out << std::setw(5) << s + 1 << "  " << std::left << std::setw(14)
            << theory.sets[s].name << std::right << std::setw(11)
            << dip_of(theory.sets[s]) << std::setw(15)
            << dip_direction_of(theory.sets[s]) << std::setw(16)
            << theory.sets[s].friction_angle << '\n';
    }

    /** One line for each pyramid that moves, one for all that do not. */
    template <int dim>
    void
    print_face(std::ostream &out,
               const BlockTheory<dim> &theory,
               const FreeFace<dim> &face)
    {
      std::string label = face.name, stable;
      for (const unsigned int p : face.removable)
        {
          const JointPyramid &pyramid = theory.pyramids[p];
          if (std::isinf(pyramid.factor))
            {
              stable += (stable.empty() ? "" : " ") + pyramid.code;
              continue;
            }
          out << "  " << std::left << std::setw(18) << label << std::setw(10)
              << pyramid.code << std::right << std::setprecision(3)
              << std::setw(8) << pyramid.factor << "  " << pyramid.mode;
          if (has_wedges(theory, face))
            {
              const RoofWedge wedge = wedge_of(theory, pyramid.code);
              out << "; at most " << std::setprecision(2) << wedge.volume
                  << " m3, " << wedge.height << " m high";
            }
          out << '\n';
          label.clear();
        }
      if (!stable.empty() || face.removable.empty())
        out << "  " << std::left << std::setw(18) << label << std::right
            << (stable.empty() ? "none" : "stable: " + stable) << '\n';
    }
  } // namespace



  template <int dim>
  void
  print_block_theory(std::ostream &out, const BlockTheory<dim> &theory)
  {
    if (!theory.remark.empty())
      {
        out << "Block theory: " << theory.remark << '\n';
        return;
      }
    const std::ios::fmtflags flags  = out.flags();
    const std::streamsize precision = out.precision();
    out << "Block theory (friction only, without stress)\n";
    print_sets(out, theory);
    out << "  " << theory.pyramids.size() - theory.n_empty() << " of "
        << theory.pyramids.size() << " joint pyramids are not empty; tapered:";
    for (const JointPyramid &pyramid : theory.pyramids)
      if (pyramid.is_empty)
        out << ' ' << pyramid.code;
    out << (theory.n_empty() == 0 ? " none\n" : "\n")
        << "  removable in      code*      factor  mode\n";
    for (const FreeFace<dim> &face : theory.faces)
      print_face(out, theory, face);
    out << "  * for each set 0: above the joint, 1: below\n";
    out.flags(flags);
    out.precision(precision);
  }



  template <int dim>
  Json
  block_theory_as_json(const BlockTheory<dim> &theory)
  {
    if (!theory.remark.empty())
      return {{"remark", theory.remark}};
    Json pyramids = Json::array(), faces = Json::array();
    for (const JointPyramid &pyramid : theory.pyramids)
      {
        const bool has_factor = std::isfinite(pyramid.factor);
        Json one              = {{"code", pyramid.code},
                                 {"mode", pyramid.mode},
                                 {"outcome",
                     pyramid.is_empty ? "tapered"
                                  : has_factor     ? "factor"
                                                   : "stable"}};
        if (has_factor)
          one["factor"] = pyramid.factor;
        pyramids.push_back(one);
      }
    for (const FreeFace<dim> &face : theory.faces)
      {
        Json one = {{"face", face.name}};
        for (const unsigned int p : face.removable)
          {
            const std::string &code = theory.pyramids[p].code;
            one["removable"].push_back(code);
            if (has_wedges(theory, face))
              one["largest_volumes"].push_back(wedge_of(theory, code).volume);
          }
        faces.push_back(one);
      }
    return {{"joint_pyramids", pyramids}, {"faces", faces}};
  }

  template void print_block_theory(std::ostream &, const BlockTheory<2> &);
  template void print_block_theory(std::ostream &, const BlockTheory<3> &);
  template Json block_theory_as_json(const BlockTheory<2> &);
  template Json block_theory_as_json(const BlockTheory<3> &);
} // namespace Keyblock
