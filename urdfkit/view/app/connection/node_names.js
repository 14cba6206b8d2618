// Names of nodes of the scene in the paths of meshcat commands.

/** The name that a component of a path stands for: it contains no slash, as `link_path` of meshcat_objects.py writes it. */
export function unescaped(part) {
  return part.replaceAll("%2F", "/").replaceAll("%25", "%");
}
