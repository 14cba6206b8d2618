"""Commands for recordings: `replay` and `bag`.

`urdfkit.bridges` reads the files, and `urdfkit.app.replay` shows them in the browser.
"""
