"""Write packages from templates: questions, answers, files, all or nothing."""

from urdfkit.scaffold.computed import computed
from urdfkit.scaffold.filling import fill
from urdfkit.scaffold.names import check_package_name, sanitised
from urdfkit.scaffold.new import create, is_fresh
from urdfkit.scaffold.outcome import Fault
from urdfkit.scaffold.question import Question, applies
from urdfkit.scaffold.reading import load_template
from urdfkit.scaffold.recipe import read_made, read_recipe
from urdfkit.scaffold.sources import named_template, template_at, template_names
from urdfkit.scaffold.template import Template
from urdfkit.scaffold.update import BESIDE, Change, Update, find_recipe, updating

__all__ = [
    "BESIDE",
    "Change",
    "Fault",
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
