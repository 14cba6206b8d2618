// The robot from the message `inspect`: links and joints by name, kinematics, joint positions.

import { Kinematics } from "./kinematics.js";

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
