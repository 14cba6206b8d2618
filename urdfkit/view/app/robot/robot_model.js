// The robot from the message `inspect`: links and joints by name, kinematics, joint positions, groups of joints.

import { Kinematics } from "./kinematics.js";

const FEW = 6; // joints; a robot with fewer is one list

export function robot(page) {
  page.robot = null;
  page.values = {};
  page.childOf = (joint) => page.robot?.joints.get(joint)?.child ?? null;
  page.on("inspect", (message) => {
    page.robot = {
      links: new Map(message.links.map((link) => [link.name, link])),
      joints: new Map(message.joints.map((joint) => [joint.name, joint])),
      kinematics: new Kinematics(message),
    };
    page.expose("kinematics", page.robot.kinematics);
    // Keep the selection unless the selected link or joint was removed.
    const { link, joint } = page.selected ?? {};
    if ((link && !page.robot.links.has(link)) || (joint && !page.robot.joints.has(joint))) page.select(null);
    page.emit("robot", page.robot);
    page.emit("select", page.selected);
  });
  page.on("joints", (message) => {
    page.values = message.positions;
  });
}

/**
 * Return the groups of joints by chain, from a branch of the tree to the next; single joints at one link are one group:
 * [{title, names}] with the rows of each group in their order; one group without title if there is one chain.
 */
export function jointGroups(names, kinematics) {
  const all = [{ title: null, names }];
  if (!kinematics || names.length < FEW) return all;
  const joints = new Map(kinematics.joints.map((joint) => [joint.name, joint]));
  const own = (name) => (joints.has(name) ? name : name.split("/")[0]); // of a variable of a joint
  const movable = new Set(names.map(own));
  if (![...movable].every((name) => joints.has(name))) return all;
  const before = (name) => {
    for (let joint = kinematics.above.get(joints.get(name).parent); joint; joint = kinematics.above.get(joint.parent)) {
      if (movable.has(joint.name)) return joint.name;
    }
    return null;
  };
  const after = new Map();
  for (const name of movable) after.set(before(name), [...(after.get(before(name)) ?? []), name]);
  const titles = new Map(); // joint → title of its group
  for (const name of movable) {
    const previous = before(name);
    if (previous !== null && after.get(previous).length === 1) continue; // not the first of its chain
    const chain = [name];
    while (after.get(chain.at(-1))?.length === 1) chain.push(after.get(chain.at(-1))[0]);
    const title = chain.length > 1 ? `to ${joints.get(chain.at(-1)).child}` : `at ${joints.get(name).parent}`;
    for (const each of chain) titles.set(each, title);
  }
  const groups = new Map();
  for (const name of names) {
    const title = titles.get(own(name));
    groups.set(title, [...(groups.get(title) ?? []), name]);
  }
  return groups.size > 1 ? [...groups].map(([title, members]) => ({ title, names: members })) : all;
}
