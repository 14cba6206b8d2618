"""A simulation that is driven from its page: the loop, the clock, the bodies it shows, the `features` of the page.

A simulator and a server go in; poses and messages go to the page, requests of the page go to the simulation.
"""
