"""Write packages from templates: questions, answers, files, all or nothing."""

from urdfkit.scaffold.computed import computed
from urdfkit.scaffold.names import check_package_name, sanitised
from urdfkit.scaffold.new import create
from urdfkit.scaffold.question import Question, applies
from urdfkit.scaffold.recipe import read_recipe
from urdfkit.scaffold.template import Template, load_template, template_names

__all__ = [
    "Question",
    "Template",
    "applies",
    "check_package_name",
    "computed",
    "create",
    "load_template",
    "read_recipe",
    "sanitised",
    "template_names",
]
