// Everything there is to see and do with a robot's figure, in the order it is set up.

import { layers } from "./layers.js";
import { joints } from "./joints.js";
import { tools } from "./tools.js";

export const viewFeatures = [tools, joints, layers];
