// ws-protocol of npm: channels, CDR of odometry, publishing, a service, an asset.
const { FoxgloveClient } = require("@foxglove/ws-protocol");
const WebSocket = require("ws");
const client = new FoxgloveClient({ ws: new WebSocket(process.argv[2], [FoxgloveClient.SUPPORTED_SUBPROTOCOL, "foxglove.sdk.v1"]) });
const seen = { topics: {}, odometry: 0, time: 0 };
const finish = (reason) => { console.log(JSON.stringify(reason ? { ...seen, reason } : seen)); process.exit(reason ? 1 : 0); };
client.on("error", (error) => finish(String(error)));
client.on("status", (status) => { seen.status = status.message; });
client.on("serverInfo", (info) => { seen.capabilities = info.capabilities; });
client.on("time", () => { seen.time++; });
let odometry;
client.on("advertise", (channels) => {
  for (const each of channels) seen.topics[each.topic] = [each.encoding, each.schemaName, each.schemaEncoding];
  const channel = channels.find((each) => each.topic === "/simpleton/odom");
  if (channel) odometry = client.subscribe(channel.id);
});
let published;
client.on("message", ({ subscriptionId, data }) => {
  if (subscriptionId !== odometry) return;
  seen.odometry++;
  // header: 4 (CDR) + 8 (stamp) + 4 + "odom\0" → 21, aligned to 24; 4 + "base_footprint\0" → 43, aligned to 52; x
  const view = new DataView(data.buffer, data.byteOffset, data.byteLength);
  const frame = view.getUint32(12, true), child = 16 + frame + ((4 - (frame % 4)) % 4);
  const after = child + 4 + view.getUint32(child, true);
  seen.x = view.getFloat64(4 + Math.ceil((after - 4) / 8) * 8, true);
  if (seen.x > 1.0 && seen.asset !== undefined && seen.service !== undefined) finish();
});
client.on("open", () => {
  published = client.advertise({ topic: "/simpleton/cmd_vel", encoding: "json", schemaName: "geometry_msgs/msg/Twist" });
  const message = new TextEncoder().encode(JSON.stringify({ linear: { x: 1.0 } }));
  setInterval(() => client.sendMessage(published, message), 20);
});
client.on("advertiseServices", (services) => {
  const service = services.find((each) => each.name === "/get_simulation_state");
  if (service) client.sendServiceCallRequest({ serviceId: service.id, callId: 7, encoding: "json", data: new DataView(new TextEncoder().encode("{}").buffer) });
});
client.on("serviceCallResponse", (response) => { seen.service = JSON.parse(new TextDecoder().decode(response.data)); });
client.on("serviceCallFailure", (failure) => { seen.service = failure.message; });
client.on("fetchAssetResponse", (response) => { seen.asset = response.status === 0 ? response.data.byteLength : response.error; });
setTimeout(() => client.fetchAsset(process.argv[3], 1), 300);
setTimeout(() => finish("timeout"), 60000);
