"""Processes of a graph whose nodes come and go, see `evidence.ros.leaving`; each in a process of its own."""

from __future__ import annotations

import os
import random
import time

import rclpy
from rclpy.executors import SingleThreadedExecutor
from rclpy.node import Node
from std_msgs.msg import String

from beardyn_ros.runtime import leave_quietly

TOPICS = tuple(f"spoken_{number}" for number in range(10))
WATCHERS = 3


def watch(pipe: int, domain: int) -> None:
    """Listen for ever; make and destroy a publisher now and then, which stops a stopped process for good."""
    context = rclpy.Context()
    rclpy.init(context=context, domain_id=domain)
    node, executor = Node("watcher", context=context), SingleThreadedExecutor(context=context)
    executor.add_node(node)
    for name in TOPICS:
        node.create_subscription(String, name, lambda _: None, 100)
    os.write(pipe, b".")
    sounded = time.monotonic()
    while True:
        executor.spin_once(timeout_sec=0.05)
        if time.monotonic() - sounded > 0.5:
            node.destroy_publisher(node.create_publisher(String, "sound", 1))
            os.write(pipe, b".")
            sounded = time.monotonic()


def come_and_go(pipe: int, domain: int, plain: bool) -> None:
    """Join, speak and leave for ever, and tell each time how long it took to be found, [s]."""
    while True:
        context = rclpy.Context()
        rclpy.init(context=context, domain_id=domain)
        node = Node("comer", context=context)
        publishers = [node.create_publisher(String, name, 100) for name in TOPICS]
        begin = time.monotonic()
        while any(each.get_subscription_count() < WATCHERS for each in publishers):
            if time.monotonic() - begin > 3.0:  # a watcher has stopped
                break
            time.sleep(0.005)
        found = time.monotonic() - begin
        for _ in range(2):
            for publisher in publishers:
                publisher.publish(String(data="spoken" * 20))
            time.sleep(random.uniform(0.0, 0.02))
        if plain:
            node.destroy_node()
        else:
            leave_quietly(node)
        context.try_shutdown()
        os.write(pipe, f"{found:.4f}\n".encode())
