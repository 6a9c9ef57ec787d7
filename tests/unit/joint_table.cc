// SPDX-License-Identifier: LGPL-2.1-or-later
// Tables of joints as geologists keep them, and what is wrong with some.
#include "world.h"

#include <boost/test/unit_test.hpp>

#include <keyblock/base/errors.h>
#include <keyblock/scene/joint_columns.h>
#include <keyblock/scene/joint_table.h>

#include <fstream>

BOOST_AUTO_TEST_SUITE(joint_table)

using namespace Keyblock;

namespace
{
  /** A file of this content, of each rank its own. */
  std::string
  write_table(const std::string &content)
  {
    const std::string name = "table_" + std::to_string(world.size()) + "_" +
                             std::to_string(world.rank()) + ".csv";
    std::ofstream(name, std::ios::binary) << content;
    return name;
  }

  template <int dim>
  std::vector<std::unique_ptr<Joint<dim>>>
  read(const std::string &content,
       const Point<dim> &origin = Point<dim>(),
       const std::map<std::string, JointStrength> &strength_of_set = {})
  {
    return read_joint_table<dim>(write_table(content), origin, strength_of_set);
  }

  /** Whether the message about this table is one sentence with all parts. */
  template <int dim>
  void
  check_refused(const std::string &content,
                const std::vector<std::string> &parts)
  {
    std::string message;
    try
      {
        read<dim>(content);
      }
    catch (const InputError &error)
      {
        message = error.message;
      }
    BOOST_TEST_CONTEXT(message)
    {
      BOOST_TEST(message.find('\n') == std::string::npos);
      BOOST_TEST(message.find("'table_") != std::string::npos);
      BOOST_REQUIRE(!message.empty());
      BOOST_TEST(message.back() == '.');
      for (const std::string &part : parts)
        BOOST_TEST(message.find(part) != std::string::npos,
                   "'" << part << "' is missing");
    }
  }
} // namespace

BOOST_AUTO_TEST_CASE(headers_of_effective_strength)
{
  for (const std::string header :
       {"phi',c'",
        "phi' (deg),c' (Pa)",
        "\xCF\x86 (\xC2\xB0),c (Pa)",
        "\"\xCF\x86\xE2\x80\xB2\n(deg)\",c\xE2\x80\x99"})
    {
      const auto joints =
        read<3>("dip,dip direction,x,y,z," + header + "\n50,30,0,0,0,20,1e4\n");
      BOOST_TEST(joints[0]->friction_angle == 20.);
      BOOST_TEST(joints[0]->cohesion == 1e4);
    }
}

BOOST_AUTO_TEST_CASE(commas_between_thousands)
{
  const std::string header = "dip;dip direction;x;y;z;c\n";
  check_refused<3>(header + "50;30;0.5;0;0;12,000\n",
                   {"Line 2", "'cohesion'", "'12,000' may be"});
  const auto joints = read<3>(header + "50;30;0,5;0;0;12,000\n");
  BOOST_TEST(joints[0]->cohesion == 12.);
}

BOOST_AUTO_TEST_CASE(lines_of_spreadsheets)
{
  const auto joints =
    read<3>("sep=;\ndip;dip direction;x;y;z\n50;30;0,5;0;0\n");
  BOOST_TEST(joints[0]->point[0] == 0.5);
  BOOST_TEST(joints[0]->origin.find("Line 3 ") == 0u);
  check_refused<3>("dip,dip direction,x,y,z\ndeg,\xC2\xB0,m,m,m\n50,30,0,0,0\n",
                   {"Line 2", "has units instead of a joint; delete it"});
}

BOOST_AUTO_TEST_CASE(table_of_discs)
{
  const auto joints = read<3>("dip,dip_direction,x,y,z,radius,phi,c\n"
                              "56.7,36.6,-5.69,10.77,-1.01,7.39,30,0\n"
                              "62.9,152.9,-7.56,6.08,2.61,6.64,35,1e4\n");
  BOOST_REQUIRE(joints.size() == 2u);
  BOOST_TEST(joints[0]->name == "J1");
  BOOST_TEST(joints[1]->name == "J2");
  BOOST_TEST(joints[1]->dip == 62.9);
  BOOST_TEST(joints[1]->dip_direction == 152.9);
  BOOST_TEST((joints[1]->point == Point<3>(-7.56, 6.08, 2.61)));
  BOOST_TEST((joints[1]->extent == JointShape::disc));
  BOOST_TEST(joints[1]->radius == 6.64);
  BOOST_TEST(joints[1]->friction_angle == 35.);
  BOOST_TEST(joints[1]->cohesion == 1e4);
  BOOST_TEST(joints[1]->kinetic_friction_angle == -1.);
}

BOOST_AUTO_TEST_CASE(table_of_half_lengths_in_feet)
{
  const auto joints =
    read<2>("dip,dip direction,x (ft),y (ft),Half length (ft)\n"
            "45,90,10,20,5\n");
  BOOST_REQUIRE(joints.size() == 1u);
  BOOST_TEST(joints[0]->point.distance(Point<2>(3.048, 6.096)) < 1e-12);
  BOOST_TEST(std::abs(joints[0]->radius - 1.524) < 1e-12);
}

// byte order mark, CR LF, comments, decimal commas, units, quotes, empty rows
BOOST_AUTO_TEST_CASE(table_of_a_spreadsheet)
{
  JointStrength strength_of_set;
  strength_of_set.friction_angle    = 25.;
  strength_of_set.cohesion          = 3e4;
  strength_of_set.residual_cohesion = 0.;
  const auto joints                 = read<3>(
    "\xEF\xBB\xBF# mapped in 2019; level 2\r\n"
                    ";;;;;;;;;\r\n"
                    "Name;Set;Strike [\xC2\xB0];Dip (deg);Easting;Northing;Elevation (km);"
                    "Diameter (cm);Cohesion kPa;Friction (static);Remarks;\r\n"
                    "\"fault A\";F1;350;45,5;1000,25;2000,5;0,3;1250;12,5;;wet;\r\n"
                    ";;;;;;;;;;\r\n"
                    " # one more\r\n"
                    ";\"F1\";10;+30;1001;2001;0,301;800;;20;\"a; \"\"b\"\"\nc\";\r\n"
                    "last;;0;9e1;1001;2001;0,301;800;0;20;;",
    Point<3>(1000., 2000., 300.),
    {{"F1", strength_of_set}});
  BOOST_REQUIRE(joints.size() == 3u);
  BOOST_TEST(joints[0]->name == "fault A");
  BOOST_TEST(joints[0]->set == "F1");
  BOOST_TEST(joints[0]->dip == 45.5);
  BOOST_TEST(joints[0]->dip_direction == 80.); // 350 + 90
  BOOST_TEST((joints[0]->point == Point<3>(0.25, 0.5, 0.)));
  BOOST_TEST(joints[0]->radius == 6.25);
  BOOST_TEST(joints[0]->cohesion == 12500.);
  BOOST_TEST(joints[0]->friction_angle == 25.); // of its set
  BOOST_TEST(joints[1]->name == "J2");
  BOOST_TEST(joints[1]->dip_direction == 100.);
  BOOST_TEST(joints[1]->cohesion == 3e4); // of its set
  BOOST_TEST(joints[1]->friction_angle == 20.);
  BOOST_TEST(joints[2]->cohesion == 0.);
  BOOST_TEST(joints[2]->dip == 90.);
}

// stiffnesses have a unit of their own
BOOST_AUTO_TEST_CASE(table_of_compliant_joints)
{
  const auto joints =
    read<3>("dip,dip direction,x,y,z,extent,normal stiffness (GPa/m),"
            "Shear stiffness\n"
            "45,90,0,0,0,infinite,2.5,1e9\n");
  BOOST_REQUIRE(joints.size() == 1u);
  BOOST_TEST(joints[0]->value_of("Normal stiffness") == 2.5e9);
  BOOST_TEST(joints[0]->value_of("Shear stiffness") == 1e9);
}

// dip = 90 - plunge, dip direction = trend + 180
BOOST_AUTO_TEST_CASE(table_of_poles)
{
  const auto joints = read<3>("trend\tplunge\tx\ty\tz\textent\tradius (mm)\n"
                              "200\t35\t0\t0\t1,5\tinfinite\t\n"
                              "10\t90\t0\t0\t1.5\tDisc\t2000\n");
  BOOST_REQUIRE(joints.size() == 2u);
  BOOST_TEST(joints[0]->dip == 55.);
  BOOST_TEST(joints[0]->dip_direction == 20.);
  BOOST_TEST((joints[0]->extent == JointShape::infinite));
  BOOST_TEST(joints[0]->point[2] == 1.5);
  BOOST_TEST(joints[1]->dip == 0.);
  BOOST_TEST(joints[1]->radius == 2.);
}

BOOST_AUTO_TEST_CASE(table_of_polygons_and_traces)
{
  const std::vector<Point<3>> corners = {Point<3>(0., 0., 0.),
                                         Point<3>(1.5, 0., 0.),
                                         Point<3>(0., 1., 1.)};
  for (const std::string text :
       {"name,vertices,friction\na,\"1 0 0; 2.5 0 0; 1 1 1\",20\n",
        "name,polygon,friction\na,\"1, 0, 0; 2.5, 0, 0; 1, 1, 1\",20\n",
        "name;polygon;friction\na;\"1 0 0; 2,5 0 0; 1 1 1\";20\n",
        "name;polygon (mm);friction\na;\"1e3,0,0; 2.5e3,0,0;1e3,1e3,1e3\";20"})
    {
      const auto joints = read<3>(text, Point<3>(1., 0., 0.));
      BOOST_REQUIRE(joints.size() == 1u);
      BOOST_TEST((joints[0]->extent == JointShape::polygon));
      BOOST_TEST((joints[0]->vertices == corners));
      BOOST_TEST(joints[0]->friction_angle == 20.);
    }
  const auto traces = read<2>("x1,y1,x2,y2\n1,2,3,4\n", Point<2>(1., 1.));
  BOOST_TEST((traces[0]->vertices ==
              std::vector<Point<2>>{Point<2>(0., 1.), Point<2>(2., 3.)}));
  const auto normals = read<3>("nx,ny,nz,x,y,z\n0,3,4,1,2,3\n");
  BOOST_TEST(std::abs(normals[0]->normal()[1] - 0.6) < 1e-15);
}

// cells as they are typed: degree signs, numbers of joints, both ways to give
// the orientation
BOOST_AUTO_TEST_CASE(table_of_a_field_book)
{
  const auto joints =
    read<3>("Joint No.;Dip;Dip direction;nx;ny;nz;x;y;z;Cohesion (kPa)\n"
            "17;60\xC2\xB0;135 \xB0;;;;0,301;0;0;12,5\n"
            "18;45;90;0,7071;0;0,7071;0.125;0;0;1.5\n");
  BOOST_REQUIRE(joints.size() == 2u);
  BOOST_TEST(joints[0]->name == "17");
  BOOST_TEST(joints[0]->dip == 60.);
  BOOST_TEST(joints[0]->dip_direction == 135.);
  BOOST_TEST(joints[0]->cohesion == 12500.);
  BOOST_TEST(joints[1]->point[0] == 0.125);
  BOOST_TEST(joints[1]->cohesion == 1500.);
  // points are decimal ones where no number has a comma
  BOOST_TEST(read<3>("dip;dip direction;x;y;z\n45;90;1.000;0;12.500\n")
               .at(0)
               ->point[2] == 12.5);
}

// elevations are the last coordinate, y in a section
BOOST_AUTO_TEST_CASE(table_of_a_section)
{
  for (const std::string title : {"Elevation", "elevation (m)", "y"})
    {
      const auto joints =
        read<2>("dip,dip direction,x," + title + "\n45,90,3,7\n");
      BOOST_TEST((joints[0]->point == Point<2>(3., 7.)), title);
    }
  BOOST_TEST(
    (read<3>("dip,dip direction,x,y,Elevation\n45,90,3,5,7\n")[0]->point ==
     Point<3>(3., 5., 7.)));
  check_refused<2>("dip,dip direction,x,y,Elevation\n45,90,3,5,7\n",
                   {"'y' twice", "'Elevation'"});
  check_refused<2>("dip,dip direction,x,z\n45,90,3,7\n", {"'z'", "2D"});
}

// what nobody computes with is left out; traces have a length
BOOST_AUTO_TEST_CASE(table_with_other_columns)
{
  // (an entry of a law, not a size)
  BOOST_TEST((read<3>("dip,dip direction,x,y,z,joint length\n45,90,0,0,0,2\n")
                .at(0)
                ->extent == JointShape::infinite));
  const std::string content =
    "ID;Station;Dip;Dip direction;x;y;z;Trace length (m);Roughness;"
    "Infill;Aperture (mm);Date;Observer;Station No.;Water condition\n"
    "1;A3;60;135;1;2;3;7,5;rough;clay;2;3 May;NN;4;wet\n";
  const auto joints = read<3>(content);
  BOOST_REQUIRE(joints.size() == 1u);
  BOOST_TEST(joints[0]->radius == 3.75);
  BOOST_TEST(joints[0]->name == "1");
  const auto titles =
    columns_left_out(read_delimited_text(write_table(content), "Joints/File"));
  BOOST_TEST((titles == std::vector<std::string>{"Station",
                                                 "Roughness",
                                                 "Infill",
                                                 "Aperture (mm)",
                                                 "Date",
                                                 "Observer",
                                                 "Station No.",
                                                 "Water condition"}));
}

// numbers of joints that are those of sets, or begin anew in each set
BOOST_AUTO_TEST_CASE(table_of_numbers_and_sets)
{
  const std::string header = "ID,Set,dip,dip direction,x,y,z\n";
  const auto names         = [&](const std::string &rows) {
    std::vector<std::string> list;
    for (const auto &joint : read<3>(header + rows))
      list.push_back(joint->name);
    return list;
  };
  using Names = std::vector<std::string>;
  BOOST_TEST((names("1,1,2,3,4,5,6\n2,2,2,3,4,5,6\n3,1,2,3,4,5,6\n") ==
              Names{"1.1", "2.2", "1.3"}));
  BOOST_TEST((names("1,A,2,3,4,5,6\n1,B,2,3,4,5,6\nf,,2,3,4,5,6\n") ==
              Names{"A.1", "B.1", "f"}));
  BOOST_TEST((names("1,A,2,3,4,5,6\n2,B,2,3,4,5,6\n") == Names{"1", "2"}));
  BOOST_TEST((names(",A,2,3,4,5,6\n,A,2,3,4,5,6\n") == Names{"J1", "J2"}));
}

BOOST_AUTO_TEST_CASE(water_in_a_table)
{
  const auto joints = read<3>("dip,dip direction,x,y,z,water pressure (kPa)\n"
                              "1,2,3,4,5,10\n1,2,3,4,5,9.81*(3-z)\n");
  BOOST_TEST(joints[0]->water_pressure == "10000");
  BOOST_TEST(joints[1]->water_pressure == "1000 * (9.81*(3-z))");
}

BOOST_AUTO_TEST_CASE(refused_tables)
{
  const std::string header = "name,dip,dip direction,x,y,z,radius\n";
  const auto refuse        = [&](const std::string &rows,
                          const std::vector<std::string> &parts) {
    check_refused<3>(header + rows, parts);
  };
  refuse("a,1,2,3,4,5,6\nb,1,2,3,four,5,6\n",
         {"Line 3", "column 'y'", "'four'", "not a number"});
  refuse("a,nan,2,3,4,5,6\n", {"Line 2", "column 'dip'", "'nan'"});
  refuse("a,1,2,inf,4,5,6\n", {"Line 2", "column 'x'", "'inf'"});
  refuse("a,1,2,3,4,5,1e999\n", {"Line 2", "column 'radius'", "'1e999'"});
  refuse("a,95,2,3,4,5,6\n", {"Line 2", "column 'dip'", "95", "0 to 90"});
  refuse("a,-1,2,3,4,5,6\n", {"Line 2", "column 'dip'", "-1", "0 to 90"});
  refuse("a,1,361,3,4,5,6\n", {"'dip direction'", "361", "0 to 360"});
  refuse("a,1,2,3,4,5,0\n", {"column 'radius'", "value 0", "not positive"});
  refuse("a,1,2,3,4,5,-2\n", {"column 'radius'", "value -2", "not positive"});
  refuse("a,1,2,3,4,5,\n", {"column 'radius'", "no value"});
  refuse("a,1,,3,4,5,6\n", {"column 'dip direction'", "no value"});
  refuse("\n\na,1,2,3\n", {"Line 4", "has 4 values", "names 7"});
  refuse("a,1,2,3,4,5,6,7\n", {"Line 2", "has 8 values"});
  refuse("\"a,1,2,3,4,5,6\n", {"Line 2", "quote without an end"});
  refuse("\"a\"b,1,2,3,4,5,6\n", {"Line 2", "'b' after the end"});
  refuse("a/b,1,2,3,4,5,6\n", {"Line 2", "'a/b'", "another name"});
  refuse("a,1,2,3,4,5,\"1,5\"\n", {"'1,5'", "not a number"});

  const std::string commas = "dip;dip direction;x;y;z;radius\n45,5;90;";
  check_refused<3>(commas + "1.000;0;0;5\n",
                   {"Line 2", "column 'x'", "'1.000'", "thousands"});
  check_refused<3>(commas + "0;0;0;12.500\n", {"'12.500'", "thousands"});
  check_refused<3>(commas + "0;-1.250.000;0;5\n", {"'-1.250.000'"});
  check_refused<3>("dip (rad),dip direction,x,y,z\n60\xC2\xB0,90,0,0,0\n",
                   {"column 'dip'", "not a number"});
  check_refused<3>("dip,dip direction,x,y,z,radius\n45,90,0,0,0,5\xB0\n",
                   {"column 'radius'", "not a number"});
  const std::string both = "nx,ny,nz,x,y,z,";
  check_refused<3>(both + "dip,dip direction\n0,0,1,0,0,0,60,90\n",
                   {"Line 2", "column 'dip'", "60 degrees away", "normal"});
  check_refused<3>(both + "dip,strike\n0.5,0,0.866,0,0,0,30,90\n",
                   {"column 'dip'", "degrees away"});
  check_refused<3>(both + "trend,plunge\n0,0,1,0,0,0,,50\n",
                   {"column 'plunge'", "40 degrees away"});
  check_refused<3>("", {"is empty"});
  check_refused<3>("# nothing\n;;\n", {"is empty"});
  check_refused<3>("\xFF\xFE"
                   "d",
                   {"UTF-16"});
  for (const std::string column : {"Coheson", "Frcition (deg)", "dip dirn"})
    check_refused<3>(
      "dip," + column + "\n",
      {"Line 1", "'" + column + "'", "may be input", "known are name, "});
  for (const std::string column :
       {"persistence", "Size (m)", "X start", "45,5"})
    check_refused<3>("dip;" + column + "\n", {"'" + column + "'"});
  check_refused<3>("dip (kPa)\n", {"'dip (kPa)'", "unit"});
  check_refused<3>("dip (furlong)\n", {"'dip (furlong)'", "unit"});
  check_refused<3>("dip,Dip angle\n", {"'dip' twice", "'Dip angle'"});
  check_refused<3>("strike,dip direction\n", {"say the same"});
  check_refused<3>("radius,diameter\n", {"say the same"});
  check_refused<3>("x1,y1,x2,y2\n", {"'x1'", "3D"});
  check_refused<2>("dip,dip direction,x,y,z\n",
                   {"'z'", "2D", "apparent dip", "'Dimension' to 3"});
  check_refused<2>("dip,x,y,z\n", {"'z'", "2D", "remove it"});
  check_refused<3>("dip,dip direction,x,y\n1,2,3,4\n",
                   {"column 'z'", "no such column"});
  check_refused<3>("vertices\n\"0 0 0; 1 0\"\n",
                   {"column 'vertices'", "'1 0'", "3 coordinates"});
  check_refused<3>("name,extent,vertices\na,polygon,\n",
                   {"column 'vertices'", "no corners"});
  check_refused<3>("name,extent\na,square\n", {"'square'", "is no extent"});
  check_refused<3>("dip,dip direction,x,y,z,friction\n1,2,3,4,5,95\n",
                   {"column 'friction angle'", "95", "0 to 89.9"});
  check_refused<3>("dip,dip direction,x,y,z,c\n1,2,3,4,5,-1\n",
                   {"column 'cohesion'", "-1", "0 or more Pa"});
}

BOOST_AUTO_TEST_SUITE_END()
