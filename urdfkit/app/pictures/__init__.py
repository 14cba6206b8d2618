"""Pictures and films of a robot for documents, by the ray caster of the camera sensors; no browser is needed.

Input: a shown robot. Output: image files.
"""
