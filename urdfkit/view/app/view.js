// Everything there is to see and do with a robot's figure, in the order it is set up.

import { cameras } from "./cameras.js";
import { capture } from "./capture.js";
import { findings } from "./findings.js";
import { help } from "./help.js";
import { ik } from "./ik.js";
import { inspector } from "./inspector.js";
import { joints } from "./joints.js";
import { labels } from "./labels.js";
import { layers } from "./layers.js";
import { measure } from "./measure.js";
import { pick } from "./pick.js";
import { robot } from "./robot.js";
import { selection } from "./selection.js";
import { sight } from "./sight.js";
import { tf } from "./tf.js";
import { steering } from "./steering.js";
import { theme } from "./theme.js";
import { tools } from "./tools.js";
import { tree } from "./tree.js";

export const viewFeatures = [
  tools, robot, sight, labels, joints, tree, inspector, layers, tf, measure, findings, cameras, capture, ik, pick, steering, selection, theme, help,
];
