// roslib of npm: topics, camera in CBOR and PNG, drives a metre, calls a service.
import * as ROSLIB from "roslib";
const ros = new ROSLIB.Ros({ url: process.argv[2] });
const seen = { x: 0 };
await new Promise((done, fail) => { ros.on("connection", done); ros.on("error", fail); });
seen.topics = await new Promise((done, fail) => ros.getTopics((found) => done(Object.fromEntries(found.topics.map((name, i) => [name, found.types[i]]))), fail));
seen.image = await new Promise((done) => {
  const camera = new ROSLIB.Topic({ ros, name: "/simpleton/camera1/image_raw", messageType: "sensor_msgs/msg/Image", compression: "cbor", throttle_rate: 100 });
  camera.subscribe((image) => { camera.unsubscribe(); done([image.encoding, image.width, image.height, image.data.length]); });
});
seen.png = await new Promise((done) => {
  const odometry = new ROSLIB.Topic({ ros, name: "/simpleton/odom", messageType: "nav_msgs/msg/Odometry", compression: "png" });
  odometry.subscribe((message) => { odometry.unsubscribe(); done(message.child_frame_id); });
});
const odometry = new ROSLIB.Topic({ ros, name: "/simpleton/odom", messageType: "nav_msgs/msg/Odometry" });
odometry.subscribe((message) => { seen.x = message.pose.pose.position.x; });
const command = new ROSLIB.Topic({ ros, name: "/simpleton/cmd_vel", messageType: "geometry_msgs/msg/Twist" });
while (seen.x <= 1.0) {
  command.publish({ linear: { x: 1.0, y: 0, z: 0 }, angular: { x: 0, y: 0, z: 0 } });
  await new Promise((done) => setTimeout(done, 20));
}
const service = new ROSLIB.Service({ ros, name: "/get_entities", serviceType: "simulation_interfaces/srv/GetEntities" });
seen.entities = await new Promise((done, fail) => service.callService({}, (answer) => done(answer.entities), fail));
console.log(JSON.stringify(seen));
ros.close();
process.exit(0);
