// Features of the robot's page, in the order of their installation.

import { cameras } from "../viewport/cameras.js";
import { capture } from "../capture/screen_capture.js";
import { collisions } from "./collision_matrix.js";
import { findings } from "./lint_findings.js";
import { groundPlanes } from "../appearance/ground_planes.js";
import { help } from "../page/keyboard_help.js";
import { history } from "../page/history.js";
import { ik } from "./inverse_kinematics.js";
import { inspector } from "./inspector.js";
import { joints } from "./joint_sliders.js";
import { labels } from "../viewport/labels.js";
import { layers } from "../viewport/display_layers.js";
import { modes } from "../page/mode_switch.js";
import { lightChoice } from "../viewport/light_choice.js";
import { loading } from "../page/loading_progress.js";
import { measure } from "./measure.js";
import { pick } from "../viewport/picking.js";
import { reach } from "./reach_map.js";
import { robot } from "./robot_model.js";
import { selection } from "../page/selection_bar.js";
import { occlusion } from "../viewport/occlusion.js";
import { tf } from "./frame_tree.js";
import { steering } from "../viewport/keyboard_camera.js";
import { theme } from "../page/theme.js";
import { tools } from "../page/toolbar.js";
import { tree } from "./link_tree.js";

export const viewFeatures = [
  tools, history, robot, occlusion, labels, joints, tree, inspector, layers, groundPlanes, loading, tf, reach, collisions, measure, findings, cameras, lightChoice, capture, ik, pick, steering, selection,
  modes, theme, help,
];
