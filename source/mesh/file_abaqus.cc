// SPDX-License-Identifier: LGPL-2.1-or-later
// Meshes from Abaqus input files.
#include <keyblock/mesh/file_formats.h>

#include <algorithm>
#include <cctype>
#include <map>
#include <sstream>
#include <stdexcept>

namespace Keyblock
{
  namespace
  {
    /** Elements that one line of a file may name; more would not fit into
     * 32-bit numbers of corners. */
    constexpr unsigned long most_members = 1ul << 28;


    /** The words between the commas of a line, in capitals, without blanks. */
    std::vector<std::string>
    split_abaqus_line(const std::string &line)
    {
      std::vector<std::string> words;
      std::istringstream in(line);
      for (std::string word; std::getline(in, word, ',');)
        {
          const auto is_blank = [](unsigned char c) { return std::isspace(c); };
          word.erase(std::remove_if(word.begin(), word.end(), is_blank),
                     word.end());
          std::transform(word.begin(), word.end(), word.begin(), ::toupper);
          words.push_back(word);
        }
      while (!words.empty() && words.back().empty())
        words.pop_back();
      return words;
    }

    /** The value of NAME=value among the words of a keyword line, or "". */
    std::string
    abaqus_parameter(const std::vector<std::string> &words,
                     const std::string &name)
    {
      for (const std::string &word : words)
        if (word.rfind(name + "=", 0) == 0)
          return word.substr(name.size() + 1);
      return "";
    }

    /** The number at the end of a set's name, as in EB5; 0 without one. */
    unsigned int
    number_of_set(const std::string &name)
    {
      const auto digits = name.find_last_not_of("0123456789") + 1;
      return digits == name.size() ? 0 : whole_number(name.substr(digits));
    }

    /** Dimension of an element type: C3D8 is a solid, T3D2 and B21 are lines,
     * the others (CPS4, CPE3, S4R, ...) surfaces. */
    unsigned int
    abaqus_dimension(const std::string &type)
    {
      if (type.rfind("C3D", 0) == 0)
        return 3;
      return type.rfind('T', 0) == 0 || type.rfind('B', 0) == 0 ? 1 : 2;
    }

    /** Number of corners of an element, which come first among its nodes. */
    unsigned int
    n_abaqus_corners(const unsigned int dimension, const unsigned int n_nodes)
    {
      if (dimension == 1)
        return 2;
      if (dimension == 2)
        return (n_nodes == 3 || n_nodes == 6) ? 3 : 4;
      const std::map<unsigned int, unsigned int> corners = {
        {10, 4}, {13, 5}, {15, 6}, {20, 8}, {27, 8}};
      const auto found = corners.find(n_nodes);
      return found == corners.end() ? n_nodes : found->second;
    }

    /** The elements that a line below *ELSET names. */
    std::vector<unsigned long>
    members_of_set(const std::vector<std::string> &words,
                   const bool is_generated)
    {
      std::vector<unsigned long> numbers;
      for (const std::string &word : words)
        if (word.find_first_not_of("0123456789") == std::string::npos)
          numbers.push_back(whole_number(word));
      if (is_generated && numbers.size() >= 2)
        {
          const unsigned long last = numbers[1];
          const unsigned long step =
            numbers.size() > 2 ? std::max(numbers[2], 1ul) : 1ul;
          numbers.resize(1);
          if (numbers[0] <= last && (last - numbers[0]) / step > most_members)
            throw std::runtime_error("a set of more than " +
                                     std::to_string(most_members) +
                                     " elements");
          while (numbers.back() + step <= last)
            numbers.push_back(numbers.back() + step);
        }
      return numbers;
    }

    /** An element of an Abaqus file. */
    struct AbaqusElement
    {
      unsigned int dimension;
      MixedMesh::Element element;
    };
  } // namespace



  MixedMesh
  read_abaqus(std::istream &in, const unsigned int dim)
  {
    MixedMesh mixed;
    std::map<unsigned long, unsigned int> vertex_of_node;
    std::map<unsigned long, AbaqusElement> elements;
    std::vector<std::string> keyword = {""};
    for (std::string line, more; std::getline(in, line);)
      {
        std::vector<std::string> words = split_abaqus_line(line);
        if (words.empty() || words[0].rfind("**", 0) == 0)
          continue;
        if (words[0][0] == '*')
          {
            keyword = words;
            continue;
          }
        const unsigned int id =
          number_of_set(abaqus_parameter(keyword, "ELSET"));
        if (keyword[0] == "*NODE")
          {
            words.resize(4, "0");
            vertex_of_node[whole_number(words[0])] = mixed.vertices.size();
            mixed.vertices.emplace_back(real_number(words[1]),
                                        real_number(words[2]),
                                        real_number(words[3]));
          }
        else if (keyword[0] == "*ELEMENT")
          {
            // a comma at the end: the nodes go on
            while (line.find_last_not_of(" \t\r") == line.rfind(',') &&
                   std::getline(in, more))
              words = split_abaqus_line(line += more);
            const unsigned int dimension =
              abaqus_dimension(abaqus_parameter(keyword, "TYPE"));
            const unsigned int n =
              n_abaqus_corners(dimension, words.size() - 1);
            AbaqusElement &record = elements[whole_number(words[0])];
            record                = {dimension, {{}, id}};
            if (words.size() <= n)
              throw std::runtime_error("element " + words[0] + " has " +
                                       std::to_string(words.size() - 1) +
                                       " nodes where its type has " +
                                       std::to_string(n));
            for (unsigned int i = 1; i <= n; ++i)
              {
                const auto node = vertex_of_node.find(whole_number(words[i]));
                if (node == vertex_of_node.end())
                  throw std::runtime_error("element " + words[0] +
                                           " names the node " + words[i] +
                                           ", which is not there");
                record.element.vertices.push_back(node->second);
              }
          }
        else if (keyword[0] == "*ELSET" && id != 0)
          for (const unsigned long number :
               members_of_set(words, keyword.back() == "GENERATE"))
            if (const auto found = elements.find(number);
                found != elements.end())
              found->second.element.id = id;
      }
    for (const auto &[number, record] : elements)
      add_element(mixed, record.element, record.dimension, dim);
    return mixed;
  }
} // namespace Keyblock
