"""PluginSpec tables: what each Gazebo plugin answers to and reads. Pure data, shared by linter, simulator and docs."""
