"""Write packages from templates, all or nothing.

A template and answers go in; packages, or changes to a description that exists, come out.
"""

from urdfkit.scaffold.templates.computed_answers import computed
from urdfkit.scaffold.templates.names import check_package_name, sanitised
from urdfkit.scaffold.templates.placeholders import fill
from urdfkit.scaffold.templates.questions import Question, applies
from urdfkit.scaffold.templates.recipe_file import read_made, read_recipe
from urdfkit.scaffold.templates.template import Template
from urdfkit.scaffold.templates.template_parser import load_template
from urdfkit.scaffold.templates.template_sources import named_template, template_at, template_names
from urdfkit.scaffold.update.changes import Change, Update
from urdfkit.scaffold.update.rendering import create, is_fresh
from urdfkit.scaffold.update.staged_packages import PackageFault
from urdfkit.scaffold.update.updating import NEW_SUFFIX, find_recipe, updating

__all__ = [
    "NEW_SUFFIX",
    "Change",
    "PackageFault",
    "Question",
    "Template",
    "Update",
    "applies",
    "check_package_name",
    "computed",
    "create",
    "fill",
    "find_recipe",
    "is_fresh",
    "load_template",
    "named_template",
    "read_made",
    "read_recipe",
    "sanitised",
    "template_at",
    "template_names",
    "updating",
]
