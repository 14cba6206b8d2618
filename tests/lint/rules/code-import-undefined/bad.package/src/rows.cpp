#include <pruner/Rowstate.h>  // <!-- expect: K994 -->
#include <ros/ros.h>

int main(int argc, char** argv) {
  ros::init(argc, argv, "rows");
  return 0;
}
