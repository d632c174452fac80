# Hosts that are network namespaces of the script that sources this, on a bridge in a namespace of its own; no packet leaves them. Needs root.
# The script has declared `address`, by host, and `domain`; `network` are then the options with which all of them hear each other.
net=roci-net-$$
network=(--domain "$domain" --peers "$(IFS=,; echo "${address[*]}")")

make_hosts() {  # ends the script with 77 where namespaces are not permitted
  local host
  ip netns add $net 2>/dev/null || exit 77
  set -e
  ip -n $net link add name switch type bridge
  ip -n $net link set switch up
  for host in "${!address[@]}"; do
    ip netns add roci-$host-$$
    ip link add name eth netns roci-$host-$$ type veth peer name $host netns $net
    ip -n roci-$host-$$ addr add ${address[$host]}/24 dev eth
    ip -n roci-$host-$$ link set lo up
    ip -n roci-$host-$$ link set eth up
    ip -n $net link set $host master switch up
  done
  set +e
}

remove_hosts() {  # with all that this script has started
  local host
  kill $(jobs -p) 2>/dev/null
  wait
  for host in net "${!address[@]}"; do ip netns del roci-$host-$$; done
}
