// What the real sdformat makes of SDF files: errors (warnings are errors), and where links, shapes and joints are.
// Usage: sdformat MODELS FILE…; prints one line each, numbers with 17 digits, and exits 1 when there was an error.
#include <cstdio>
#include <iostream>
#include <string>
#include <sdf/sdf.hh>

static void Show(const std::string &kind, const std::string &name, const ignition::math::Pose3d &pose)
{
  std::printf("%s\t%s\t%.17g %.17g %.17g %.17g %.17g %.17g %.17g\n", kind.c_str(), name.c_str(), pose.Pos().X(),
    pose.Pos().Y(), pose.Pos().Z(), pose.Rot().X(), pose.Rot().Y(), pose.Rot().Z(), pose.Rot().W());
}

template <typename T> static ignition::math::Pose3d PoseOf(const T &thing, const std::string &frame)
{
  ignition::math::Pose3d pose;
  for (const auto &error : thing.SemanticPose().Resolve(pose, frame)) std::cout << "error\t" << error.Message() << "\n";
  return pose;
}

static void Show(const sdf::Model &model, const std::string &prefix, const ignition::math::Pose3d &placed)
{
  for (uint64_t i = 0; i < model.LinkCount(); ++i) {
    const auto *link = model.LinkByIndex(i);
    const auto pose = placed * PoseOf(*link, "__model__");
    Show("link", prefix + link->Name(), pose);
    for (uint64_t j = 0; j < link->CollisionCount(); ++j) {
      const auto *shape = link->CollisionByIndex(j);
      Show("collision", prefix + link->Name() + "/" + shape->Name(), pose * PoseOf(*shape, link->Name()));
    }
  }
  for (uint64_t i = 0; i < model.JointCount(); ++i) {
    const auto *joint = model.JointByIndex(i);
    std::string child, parent;
    joint->ResolveChildLink(child);
    joint->ResolveParentLink(parent);
    Show("joint", prefix + joint->Name(), placed * PoseOf(*joint, "__model__"));
    std::cout << "ends\t" << prefix + joint->Name() << "\t" << parent << " " << child << std::endl;
    if (const auto *axis = joint->Axis(0)) {
      ignition::math::Vector3d xyz;
      axis->ResolveXyz(xyz);
      Show("axis", prefix + joint->Name(), ignition::math::Pose3d(xyz, ignition::math::Quaterniond::Identity));
    }
  }
  for (uint64_t i = 0; i < model.ModelCount(); ++i) {
    const auto *nested = model.ModelByIndex(i);
    Show(*nested, prefix + nested->Name() + "::", placed * PoseOf(*nested, "__model__"));
  }
}

int main(int argc, char **argv)
{
  int errors = 0;
  sdf::addURIPath("model://", argv[1]);
  auto config = sdf::ParserConfig::GlobalConfig();
  config.SetWarningsPolicy(sdf::EnforcementPolicy::ERR);
  config.SetUnrecognizedElementsPolicy(sdf::EnforcementPolicy::ERR);
  for (int i = 2; i < argc; ++i) {
    sdf::Root root;
    for (const auto &error : root.Load(argv[i], config)) {
      std::cout << "error\t" << argv[i] << "\t" << error.Message() << std::endl;
      ++errors;
    }
    for (uint64_t w = 0; w < root.WorldCount(); ++w)
      for (uint64_t m = 0; m < root.WorldByIndex(w)->ModelCount(); ++m) {
        const auto *model = root.WorldByIndex(w)->ModelByIndex(m);
        Show(*model, model->Name() + "::", PoseOf(*model, "world"));
      }
  }
  return errors != 0;
}
