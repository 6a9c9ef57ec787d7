// SPDX-License-Identifier: LGPL-2.1-or-later
#include <deal.II/base/utilities.h>

#include <keyblock/output/output.h>
#include <keyblock/scene/network_output.h>

namespace Keyblock
{
  template <int dim>
  Output<dim>::Output(const Scene<dim> &scene,
                      const SplitMesh<dim> &split,
                      const Blocks<dim> &blocks,
                      const Numbering<dim> &numbering,
                      const CellArrays<dim> &cells,
                      const Fields<dim> &fields,
                      const Contact<dim> *contact,
                      const std::vector<SafetyFactor> &factors,
                      const std::string &folder)
    : scene(scene)
    , split(split)
    , blocks(blocks)
    , numbering(numbering)
    , cells(cells)
    , fields(fields)
    , contact(contact)
    , factors(factors)
    , folder(folder)
  {}



  template <int dim>
  std::string
  Output<dim>::stage_name() const
  {
    return stage < 2 ? "start" : scene.stages[stage - 2]->name;
  }



  template <int dim>
  VtuGrid
  Output<dim>::make_grid(const double time) const
  {
    std::vector<std::string> stages = {"none", "start"};
    for (const std::string &name : names_of(scene.stages))
      stages.push_back(name);
    VtuGrid grid;
    std::vector<double> places;
    for (const Point<dim> &vertex : split.mesh.vertices)
      for (unsigned int d = 0; d < 3; ++d)
        places.push_back(d < dim ? vertex[d] : 0.);
    grid.is_far = are_far(places);
    grid.time   = time;
    grid.texts  = {{"stage", {stage_name()}},
                   {"excavation stage names", stages},
                   {"material names", names_of(scene.materials)},
                   {"joint names", names_of(scene.joints)}};
    return grid;
  }



  template <int dim>
  std::string
  Output<dim>::write(const VtuGrid &grid,
                     const std::string &base,
                     const unsigned int number) const
  {
    std::string name = base + "_" + dealii::Utilities::int_to_string(number, 4);
    const Communicator &ranks = numbering.communicator;
    bool is_written;
    if (ranks.size() == 1)
      {
        name += ".vtu";
        is_written = Keyblock::write_vtu(grid, folder + name);
      }
    else
      {
        std::vector<std::string> pieces;
        for (unsigned int r = 0; r < ranks.size(); ++r)
          pieces.push_back(name + "." + std::to_string(r) + ".vtu");
        name += ".pvtu";
        is_written = Keyblock::write_vtu(grid, folder + pieces[ranks.rank()]);
        if (ranks.is_root())
          is_written = write_pvtu(grid, pieces, folder + name) && is_written;
      }
    ranks.assert_written(is_written, folder + name);
    return name;
  }



  template <int dim>
  void
  Output<dim>::write_vtu(const double time)
  {
    const unsigned int number = records.size() / 2;
    records.push_back(
      {time, write(make_rock(time), "rock", number), "rock", stage_name()});
    records.push_back({time,
                       write(make_interface(time), "interface", number),
                       "interface",
                       stage_name()});
    const std::string collection = folder + "solution.pvd";
    numbering.communicator.assert_written(!numbering.communicator.is_root() ||
                                            write_pvd(records, collection),
                                          collection);
  }



  template <int dim>
  void
  Output<dim>::rewrite_rock(const double time) const
  {
    if (!records.empty() && records.back().time == time &&
        records.back().stage == stage_name())
      write(make_rock(time), "rock", records.size() / 2 - 1);
  }

  template class Output<2>;
  template class Output<3>;
} // namespace Keyblock
