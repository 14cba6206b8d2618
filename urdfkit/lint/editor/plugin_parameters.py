"""Lookup of plugin tables for a tag, and the descriptions of plugin parameters."""

from urdfkit.description.plugins.spec import Parameter, PluginSpec
from urdfkit.lint.model.tags import Tag


def plugin_around(tag: Tag | None) -> list[PluginSpec]:
    """Return the tables of the plugin at a tag; empty if the tag is not a plugin or the plugin is unknown."""
    written = tag.attributes.get("filename") if tag is not None and tag.name == "plugin" else None
    if written is None or tag is None:
        return []
    from urdfkit.description.plugins import ALL_SPECS
    from urdfkit.description.plugins.lookup import stem

    name = tag.attributes.get("name")
    found = [spec for spec in ALL_SPECS if stem(written.value) in spec.filenames]
    exact = [spec for spec in found if name is not None and name.value.strip() in spec.class_names]
    return exact or found


def described(parameter: Parameter) -> str:
    """Return a short description of a parameter."""
    meaning = parameter.meaning.replace("_", " ")
    unit = f" {parameter.unit}" if parameter.unit else ""
    default = parameter.default
    rest = "has to be written" if default is None else f"default `{default}`" if default else "default empty"
    names = f"; names a {parameter.names}" if parameter.names else ""
    return f"{meaning}{unit}, {rest}{names}"
