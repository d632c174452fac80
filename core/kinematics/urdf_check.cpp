#include "core/kinematics/urdf_check.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <sstream>

#include "core/kinematics/urdf_xml.hpp"

namespace roci::kinematics {
namespace {

using tinyxml2::XMLElement;

constexpr double kRoundedMoment = 1e-9;  // kg·m²; files round what they write

const XMLElement& child(const XMLElement& parent, const char* name, const std::string& remedy) {
  const XMLElement* found = parent.FirstChildElement(name);
  if (found == nullptr) xml::fail(parent, remedy);
  return *found;
}

void check_origin(const XMLElement& parent) {
  const XMLElement* origin = parent.FirstChildElement("origin");
  if (origin == nullptr) return;
  xml::numbers(*origin, "xyz", 3, {});
  xml::numbers(*origin, "rpy", 3, {});
}

void require_positive(const XMLElement& element, const char* attribute) {
  if (xml::required_number(element, attribute) <= 0) {
    xml::fail(element, std::string("attribute '") + attribute + "' must be above 0");
  }
}

// Limits beyond these are slips of the pen: a motion would take years, or no time.
constexpr double kLeastRate = 1e-4, kMostRate = 1e4;      // rad or m, per s, s² and s³
constexpr double kLeastEffort = 1e-3, kMostEffort = 1e7;  // N·m or N
constexpr double kFarthest = 1000;                        // rad or m

double require_between(const XMLElement& element, const char* attribute, double least, double most,
                       const std::string& unit) {
  const double value = xml::required_number(element, attribute);
  if (value >= least && value <= most) return value;
  std::ostringstream message;
  message << "attribute '" << attribute << "' must be between " << least << " and " << most << " " << unit;
  xml::fail(element, message.str());
}

void check_geometry(const XMLElement& collision) {
  const XMLElement& geometry = child(collision, "geometry", "needs a <geometry>");
  const XMLElement* shape = geometry.FirstChildElement();
  const std::string kind = shape == nullptr ? "nothing" : shape->Name();
  if (kind == "sphere") {
    require_positive(*shape, "radius");
  } else if (kind == "cylinder") {
    require_positive(*shape, "radius");
    require_positive(*shape, "length");
  } else if (kind == "box") {
    xml::required_text(*shape, "size");
    for (double edge : xml::numbers(*shape, "size", 3, {})) {
      if (edge <= 0) xml::fail(*shape, "attribute 'size' must be three numbers above 0");
    }
  } else {
    xml::fail(geometry, "collision geometry must be a box, cylinder or sphere, not " + kind +
                            "; cover a mesh with some of these");
  }
}

void check_inertial(const XMLElement& inertial) {
  const XMLElement& mass = child(inertial, "mass", "needs a <mass value=\"…\"/>");
  if (xml::required_number(mass, "value") < 0) xml::fail(mass, "a mass cannot be below 0");
  const XMLElement& inertia = child(inertial, "inertia", "needs an <inertia ixx=\"…\" …/>");
  const auto entry = [&inertia](const char* name) { return xml::required_number(inertia, name); };
  const double ixx = entry("ixx"), ixy = entry("ixy"), ixz = entry("ixz"), iyy = entry("iyy"),
               iyz = entry("iyz"), izz = entry("izz");
  const Eigen::Matrix3d matrix{{ixx, ixy, ixz}, {ixy, iyy, iyz}, {ixz, iyz, izz}};
  const Eigen::Vector3d moments =
      Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(matrix, Eigen::EigenvaluesOnly).eigenvalues();
  if (!(moments[0] >= -kRoundedMoment * std::max(1.0, moments[2]))) {
    xml::fail(inertia,
              "the moments of inertia must not be negative, about no axis (the least is " +
                  std::to_string(moments[0]) +
                  " kg·m²); check the signs of ixx … izz, or give those of a box of the link's size");
  }
}

void check_link(const XMLElement& link) {
  if (const XMLElement* inertial = link.FirstChildElement("inertial")) {
    check_origin(*inertial);
    check_inertial(*inertial);
  }
  for (const XMLElement* shape = link.FirstChildElement("collision"); shape != nullptr;
       shape = shape->NextSiblingElement("collision")) {
    check_origin(*shape);
    check_geometry(*shape);
  }
}

void check_axis(const XMLElement& joint) {
  const XMLElement* axis = joint.FirstChildElement("axis");
  if (axis == nullptr) return;  // URDF's default: x
  double square = 0;
  for (double value : xml::numbers(*axis, "xyz", 3, {1, 0, 0})) square += value * value;
  if (!(square > 1e-12)) {
    xml::fail(joint, "the axis must not be zero; give a direction such as <axis xyz=\"0 0 1\"/>");
  }
}

void check_limits(const XMLElement& joint, bool bounded, UrdfNotes& notes) {
  const XMLElement& limit = child(
      joint, "limit", "has no limits; add <limit lower=\"…\" upper=\"…\" velocity=\"…\" effort=\"…\"/>");
  if (bounded && !(require_between(limit, "lower", -kFarthest, kFarthest, "rad or m") <
                   require_between(limit, "upper", -kFarthest, kFarthest, "rad or m"))) {
    xml::fail(joint, "the lower limit must be below the upper limit");
  }
  require_between(limit, "velocity", kLeastRate, kMostRate, "rad/s or m/s");
  require_between(limit, "effort", kLeastEffort, kMostEffort, "N·m or N");
  if (limit.Attribute("acceleration") != nullptr) {
    notes.acceleration[joint.Attribute("name")] =
        require_between(limit, "acceleration", kLeastRate, kMostRate, "rad/s² or m/s²");
  }
  if (limit.Attribute("jerk") != nullptr) {
    notes.jerk[joint.Attribute("name")] =
        require_between(limit, "jerk", kLeastRate, kMostRate, "rad/s³ or m/s³");
  }
}

void check_dynamics(const XMLElement& joint) {
  const XMLElement* dynamics = joint.FirstChildElement("dynamics");
  if (dynamics == nullptr) return;
  for (const char* term : {"friction", "damping"}) {
    for (double value : xml::numbers(*dynamics, term, 1, {})) {
      if (value < 0) xml::fail(joint, std::string(term) + " cannot be below 0");
    }
  }
}

void check_joint(const XMLElement& joint, UrdfNotes& notes) {
  const std::string type = xml::required_text(joint, "type");
  check_origin(joint);
  if (type == "fixed") return;
  if (type != "revolute" && type != "prismatic" && type != "continuous") {
    xml::fail(joint, "type '" + type + "' is not one of revolute, continuous, prismatic, fixed");
  }
  check_axis(joint);
  check_limits(joint, type != "continuous", notes);
  check_dynamics(joint);
}

// Checks that the links form one tree: every link is at most once a child, there is no way round, and there
// is one root.
void check_tree(const XMLElement& robot, const UrdfNotes& notes) {
  std::map<std::string, std::string> parent_of;
  for (const XMLElement* joint = robot.FirstChildElement("joint"); joint != nullptr;
       joint = joint->NextSiblingElement("joint")) {
    const std::string parent =
        xml::required_text(child(*joint, "parent", "needs a <parent link=\"…\"/>"), "link");
    const std::string below =
        xml::required_text(child(*joint, "child", "needs a <child link=\"…\"/>"), "link");
    for (const std::string& link : {parent, below}) {
      if (!notes.link_line.contains(link)) xml::fail(*joint, "link '" + link + "' is not in the document");
    }
    if (!parent_of.emplace(below, parent).second) {
      xml::fail(*joint,
                "link '" + below + "' is the child of two joints; a serial arm has one way to each link");
    }
    for (auto up = parent_of.find(below); up != parent_of.end(); up = parent_of.find(up->second)) {
      if (up->second == below) xml::fail(*joint, "closes a cycle through link '" + below + "'");
    }
  }
  if (parent_of.size() + 1 != notes.link_line.size()) {
    xml::fail(robot, "links do not form one tree: " + std::to_string(notes.link_line.size()) + " links, " +
                         std::to_string(parent_of.size()) +
                         " joints; every link but one needs a parent joint");
  }
}

UrdfNotes check_robot(const XMLElement& robot) {
  UrdfNotes notes;
  xml::required_text(robot, "name");
  for (const XMLElement* part = robot.FirstChildElement(); part != nullptr;
       part = part->NextSiblingElement()) {
    const std::string kind = part->Name();
    if (kind != "link" && kind != "joint") continue;
    auto& lines = kind == "link" ? notes.link_line : notes.joint_line;
    if (!lines.emplace(xml::required_text(*part, "name"), part->GetLineNum()).second) {
      xml::fail(*part, "this name stands twice in the document");
    }
    if (kind == "link") {
      check_link(*part);
    } else {
      check_joint(*part, notes);
    }
  }
  check_tree(robot, notes);
  return notes;
}

}  // namespace

std::variant<UrdfNotes, UrdfError> check_urdf(const std::string& text, const std::string& file) {
  tinyxml2::XMLDocument document;
  if (document.Parse(text.data(), text.size()) != tinyxml2::XML_SUCCESS) {
    return UrdfError{
        file, document.ErrorLineNum(), "document",
        std::string("not XML (") + document.ErrorName() + "); mend the syntax at or before this line"};
  }
  const XMLElement* robot = document.RootElement();
  if (robot == nullptr || std::string(robot->Name()) != "robot") {
    return UrdfError{file, robot == nullptr ? 0 : robot->GetLineNum(), "document",
                     "a URDF's root element is <robot>"};
  }
  try {
    return check_robot(*robot);
  } catch (const xml::Failure& failure) {
    return UrdfError{file, failure.line, failure.element, failure.message};
  }
}

}  // namespace roci::kinematics
