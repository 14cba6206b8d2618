"""Learn to drive Simpleton to a goal, with PPO of Stable-Baselines3: python docs/tutorials/drive_to_goal.py."""

import sys
import time

import numpy as np
import torch
from stable_baselines3 import PPO
from stable_baselines3.common.vec_env import VecMonitor

from urdfkit.sim.environments.stable_baselines import RobotVecEnv

VARY = {"task.x": (-2.0, 2.0), "task.y": (-2.0, 2.0), "spawn.yaw": (-np.pi, np.pi), "chassis.mass": (0.8, 1.2)}


def drive_to_goal(batch):
    """Return the goal in the axes of the robot and its velocity; reward each metre towards the goal."""
    goal = np.stack([batch.parameters["task.x"], batch.parameters["task.y"]], axis=1)
    x, y = (goal - batch.base_pose[:, :2]).T
    qz, qw = batch.base_pose[:, 5], batch.base_pose[:, 6]
    cos, sin = 1.0 - 2.0 * qz**2, 2.0 * qw * qz
    ahead, left = cos * x + sin * y, cos * y - sin * x
    distance = np.hypot(ahead, left)
    forward, turning = batch.base_twist[:, 0], batch.base_twist[:, 5]
    observations = np.stack([ahead, left, distance, forward, turning], axis=1)
    arrived = distance < 0.15
    towards = forward * ahead / np.maximum(distance, 0.15)
    return observations, 0.1 * towards - 0.02 + 5.0 * arrived, arrived


def evaluate(policy, worlds=200):
    """Return the mean reward and the share of arrivals in the first episode of each world."""
    environment = RobotVecEnv("simpleton", drive_to_goal, worlds, **OPTIONS)
    environment.seed(1)
    observations = environment.reset()
    rewards, running, arrived = np.zeros(worlds), np.ones(worlds, bool), np.zeros(worlds, bool)
    while running.any():
        observations, reward, done, infos = environment.step(policy.predict(observations, deterministic=True)[0])
        rewards += reward * running
        arrived |= running & done & [not info.get("TimeLimit.truncated", False) for info in infos]
        running &= ~done
    environment.close()
    return rewards.mean(), arrived.mean()


OPTIONS = {"vary": VARY, "action_period": 0.1, "time_limit": 10.0}

if __name__ == "__main__":
    steps = int(sys.argv[1]) if len(sys.argv) > 1 else 200_000
    torch.set_num_threads(1)  # the networks are small, and the worlds use all cores
    environment = VecMonitor(RobotVecEnv("simpleton", drive_to_goal, 64, **OPTIONS))
    policy = PPO("MlpPolicy", environment, n_steps=64, batch_size=1024, gamma=0.98, learning_rate=1e-3, seed=0)
    print("before: mean reward {:.2f}, {:.0%} arrive".format(*evaluate(policy)))
    start = time.monotonic()
    policy.learn(steps)
    print(f"{steps} actions learned in {(time.monotonic() - start) / 60:.1f} minutes")
    print("after:  mean reward {:.2f}, {:.0%} arrive".format(*evaluate(policy)))
    environment.close()
